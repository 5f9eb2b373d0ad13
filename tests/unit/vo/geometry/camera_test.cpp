#include "support/temporary_folder.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/geometry/camera.hpp>
#include <vo/io/camera_calibration.hpp>

namespace {

using testing::HasSubstr;

TEST(Camera, OfAFieldOfViewSeesHalfOfItAtTheRim) {
  const vo::Camera camera = vo::camera_from_fov(640, 360, 90);
  EXPECT_NEAR(camera.fx_px, 320, 1e-9);  // tan 45 degrees = 1
  const auto rim = vo::undistort(camera, {{-0.5, 179.5}, {639.5, 179.5}, {319.5, 179.5}});
  EXPECT_NEAR(rim[0].x, -1, 1e-12);
  EXPECT_NEAR(rim[1].x, 1, 1e-12);
  EXPECT_NEAR(rim[2].x, 0, 1e-12);
  EXPECT_NEAR(rim[2].y, 0, 1e-12);
  EXPECT_THROW(vo::camera_from_fov(640, 360, 9.9), std::invalid_argument);
  EXPECT_THROW(vo::camera_from_fov(640, 360, 171), std::invalid_argument);
  EXPECT_THROW(vo::camera_from_fov(0, 360, 60), std::invalid_argument);
}

TEST(Camera, ResizedSeesTheSameRays) {
  vo::Camera camera = vo::camera_from_fov(1280, 720, 70);
  camera.cx_px += 31;
  const vo::Camera half = vo::resized(camera, 640);
  EXPECT_EQ(half.height_px, 360);
  // The corner between four pixels of the large picture is the middle of one of the small.
  const auto large = vo::undistort(camera, {{200.5, 100.5}}), small = vo::undistort(half, {{100, 50}});
  EXPECT_NEAR(large[0].x, small[0].x, 1e-12);
  EXPECT_NEAR(large[0].y, small[0].y, 1e-12);
}

TEST(Camera, UndistortsPoints) {
  vo::Camera camera = vo::camera_from_fov(640, 480, 60);
  camera.distortion = {-0.2, 0.05, 0.001, -0.002};
  // The model forwards (OpenCV: radial, then tangential), of a point on the plane.
  const double x = 0.3, y = -0.2, r2 = x * x + y * y;
  const double radial = 1 - 0.2 * r2 + 0.05 * r2 * r2;
  const double xd = x * radial + 2 * 0.001 * x * y - 0.002 * (r2 + 2 * x * x);
  const double yd = y * radial + 0.001 * (r2 + 2 * y * y) - 2 * 0.002 * x * y;
  const auto back =
      vo::undistort(camera, {{camera.cx_px + camera.fx_px * xd, camera.cy_px + camera.fy_px * yd}});
  EXPECT_NEAR(back[0].x, x, 1e-4);  // OpenCV's five iterations
  EXPECT_NEAR(back[0].y, y, 1e-4);
  EXPECT_TRUE(vo::undistort(camera, {}).empty());
}

class CameraCalibration : public testing::Test {
 protected:
  std::string file(const std::string& text) {
    const auto path = folder_.path() / "camera.yml";
    std::ofstream(path) << text;
    return path.string();
  }
  static std::string message(const std::string& path) {
    try {
      vo::read_camera_calibration(path);
    } catch (const vo::Error& error) {
      return error.what();
    }
    return "no error";
  }
  static std::string calibration(const std::string& distortion) {
    return "%YAML:1.0\n---\nimage_width: 848\nimage_height: 480\ncamera_matrix: !!opencv-matrix\n   rows: "
           "3\n   cols: 3\n"
           "   dt: d\n   data: [ 610., 0., 423., 0., 612., 239., 0., 0., 1. ]\n" +
           distortion;
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(CameraCalibration, IsReadAsOpenCvWritesIt) {
  const vo::Camera camera = vo::read_camera_calibration(
      file(calibration("distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
                       "   data: [ -0.1, 0.02, 0., 0.001, 0. ]\n")));
  EXPECT_EQ(camera.width_px, 848);
  EXPECT_EQ(camera.height_px, 480);
  EXPECT_EQ(camera.fx_px, 610);
  EXPECT_EQ(camera.fy_px, 612);
  EXPECT_EQ(camera.cx_px, 423);
  EXPECT_EQ(camera.cy_px, 239);
  EXPECT_THAT(camera.distortion, testing::ElementsAre(-0.1, 0.02, 0, 0.001, 0));
  EXPECT_THAT(vo::read_camera_calibration(file(calibration(""))).distortion, testing::IsEmpty());
}

TEST_F(CameraCalibration, SaysWhatIsMissing) {
  EXPECT_THAT(message((folder_.path() / "none.yml").string()), HasSubstr("does not exist"));
  EXPECT_THAT(message(file("not a calibration")), HasSubstr("is no YAML"));
  EXPECT_THAT(message(file("%YAML:1.0\n---\nimage_width: 848\n")), HasSubstr("image_height"));
  EXPECT_THAT(message(file("%YAML:1.0\n---\nimage_width: 848\nimage_height: 480\n")),
              HasSubstr("camera_matrix"));
  EXPECT_THAT(
      message(file(calibration("distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 3\n   dt: d\n"
                               "   data: [ 1., 2., 3. ]\n"))),
      HasSubstr("3 distortion_coefficients"));
}

TEST(Camera, RadialDistortionComesAndGoes) {
  const vo::ImagePoint seen = vo::with_radial({0.3, -0.4}, 0.2);  // r^2 = 0.25
  EXPECT_NEAR(seen.x, 0.3 * 1.05, 1e-12);
  EXPECT_NEAR(seen.y, -0.4 * 1.05, 1e-12);
  for (const double radial : {-0.05, 0.0, 0.02, 0.1}) {
    const vo::ImagePoint back = vo::without_radial(vo::with_radial({0.7, 0.5}, radial), radial);
    EXPECT_NEAR(back.x, 0.7, 1e-5) << radial;  // a hundredth of a pixel at 1000 px focal length
    EXPECT_NEAR(back.y, 0.5, 1e-5) << radial;
  }
}

TEST(Camera, OfARecordingIsTheCalibratedOne) {
  const vo::Camera calibrated = vo::camera_from_fov(640, 360, 80);
  EXPECT_EQ(vo::camera_of_recording(calibrated, 640, 360, 60).fx_px, calibrated.fx_px);
  EXPECT_EQ(vo::camera_of_recording(std::nullopt, 640, 360, 60).fx_px,
            vo::camera_from_fov(640, 360, 60).fx_px);
  EXPECT_THROW(vo::camera_of_recording(calibrated, 640, 480, 60), vo::Error);
}

}  // namespace
