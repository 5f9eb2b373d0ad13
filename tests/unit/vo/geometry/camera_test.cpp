#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/geometry/camera.hpp>

namespace {

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

TEST(Camera, UndistortsAFisheye) {
  vo::Camera camera = vo::camera_from_fov(640, 480, 90);
  camera.lens = vo::LensModel::kEquidistant;
  camera.distortion = {0, 0, 0, 0};
  // Without coefficients the radius is the angle itself: 45 degrees are pi / 4 focal lengths from the middle.
  const double radius_px = camera.fx_px * std::numbers::pi / 4;
  const auto points =
      vo::undistort(camera, {{camera.cx_px + radius_px, camera.cy_px}, {camera.cx_px, camera.cy_px}});
  EXPECT_NEAR(points[0].x, 1, 1e-6);  // OpenCV's Newton steps end at 1e-8 rad
  EXPECT_NEAR(points[0].y, 0, 1e-9);
  EXPECT_NEAR(points[1].x, 0, 1e-9);
  // With them: 30 degrees at theta (1 + k1 theta^2 + k2 theta^4).
  camera.distortion = {0.02, -0.003, 0, 0};
  const double theta = std::numbers::pi / 6, t2 = theta * theta;
  const double bent_px = camera.fx_px * theta * (1 + 0.02 * t2 - 0.003 * t2 * t2);
  EXPECT_NEAR(vo::undistort(camera, {{camera.cx_px, camera.cy_px - bent_px}})[0].y, -std::tan(theta), 1e-6);
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
  // Of another size and the same shape, it sees the same rays.
  const vo::Camera scaled = vo::camera_of_recording(calibrated, 1280, 720, 60);
  EXPECT_EQ(scaled.height_px, 720);
  EXPECT_NEAR(scaled.fx_px, 2 * calibrated.fx_px, 1e-9);
  EXPECT_EQ(vo::camera_of_recording(vo::camera_from_fov(1280, 720, 80), 854, 480, 60).height_px, 480);
  // One that does not say its size is the recording's, if its middle says nothing else.
  vo::Camera unsized = calibrated;
  unsized.width_px = unsized.height_px = 0;
  EXPECT_EQ(vo::camera_of_recording(unsized, 640, 360, 60).width_px, 640);
  EXPECT_EQ(vo::camera_of_recording(unsized, 640, 360, 60).fx_px, calibrated.fx_px);
  EXPECT_THROW(vo::camera_of_recording(unsized, 1280, 720, 60), vo::Error);
}

}  // namespace
