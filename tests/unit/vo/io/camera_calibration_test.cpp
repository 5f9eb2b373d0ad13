#include "support/temporary_folder.hpp"

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vo/base/error.hpp>
#include <vo/io/camera_calibration.hpp>

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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

TEST_F(CameraCalibration, OpenCvMayLeaveTheSizeOut) {
  const vo::Camera camera = vo::read_camera_calibration(
      file("%YAML:1.0\n---\nK: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
           "   data: [ 610., 0., 423., 0., 612., 239., 0., 0., 1. ]\n"));
  EXPECT_EQ(camera.width_px, 0);  // `camera_of_recording` takes the recording's
  EXPECT_EQ(camera.height_px, 0);
  EXPECT_EQ(camera.fx_px, 610);
}

TEST_F(CameraCalibration, SaysWhatIsMissing) {
  EXPECT_THAT(message((folder_.path() / "none.yml").string()), HasSubstr("does not exist"));
  EXPECT_THAT(message(file("not a calibration")), HasSubstr("is no YAML"));
  EXPECT_THAT(message(file("<opencv_storage><a>")), HasSubstr("is no XML"));
  EXPECT_THAT(message(file("")), HasSubstr("is no YAML"));
  EXPECT_THAT(message(file("%YAML:1.0\n---\nimage_width: 848\n")), HasSubstr("image_height"));
  EXPECT_THAT(message(file("%YAML:1.0\n---\nimage_width: 0\n")), HasSubstr("camera_matrix"));
  EXPECT_THAT(message(file("%YAML:1.0\n---\nimage_width: 848\nimage_height: 480\n")),
              HasSubstr("camera_matrix"));
  EXPECT_THAT(
      message(file(calibration("distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 3\n   dt: d\n"
                               "   data: [ 1., 2., 3. ]\n"))),
      HasSubstr("3 distortion_coefficients"));
}

void expect_pinhole(const vo::Camera& camera) {
  EXPECT_EQ(camera.lens, vo::LensModel::kOpenCv);
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.height_px, 360);
  EXPECT_EQ(camera.fx_px, 508.5);
  EXPECT_EQ(camera.fy_px, 507.5);
  EXPECT_EQ(camera.cx_px, 319);
  EXPECT_EQ(camera.cy_px, 179.5);
}

constexpr const char* kRos = R"(image_width: 640
image_height: 360
camera_name: head_camera
camera_matrix:
  rows: 3
  cols: 3
  data: [508.5, 0., 319., 0.,
         507.5, 179.5, 0., 0., 1.]
distortion_model: plumb_bob  # or rational_polynomial
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.1, -0.2, 0, 0, 0]
projection_matrix:
  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]
)";

constexpr const char* kKalibr = R"(cam0:
  T_cam_imu:
  - [0.0, 1.0, 0.0, 0.1]
  - [1.0, 0.0, 0.0, 0.2]
  cam_overlaps: []
  camera_model: pinhole
  distortion_coeffs: [0.1, -0.2, 0.0, 0.0]
  distortion_model: radtan
  intrinsics: [508.5, 507.5, 319, 179.5]
  resolution: [640, 360]
  rostopic: /cam0/image_raw
cam1:
  camera_model: omni
  intrinsics: [1, 2, 3, 4, 5]
)";

constexpr const char* kOrbSlam = R"(%YAML:1.0
#--- camera
Camera.type: "PinHole"
Camera.fx: 508.5
Camera.fy: 507.5
Camera.cx: 319
Camera.cy: 179.5
Camera.k1: 0.1
Camera.k2: -0.2
Camera.p1: 0.0
Camera.p2: 0.0
Camera.width: 640
Camera.height: 360
Camera.fps: 25.0
)";

std::string without_line(const std::string& text, const std::string& key) {
  const std::size_t begin = text.find(key);
  return text.substr(0, begin) + text.substr(text.find('\n', begin) + 1);
}

std::string with(const std::string& text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return text.substr(0, at) + by + text.substr(at + what.size());
}

TEST_F(CameraCalibration, IsReadAsOtherProgramsWriteIt) {
  for (const char* text : {kRos, kKalibr, kOrbSlam}) {
    const vo::Camera camera = vo::read_camera_calibration(file(text));
    expect_pinhole(camera);
    EXPECT_EQ(camera.distortion[0], 0.1);
    EXPECT_EQ(camera.distortion[1], -0.2);
  }
  expect_pinhole(vo::read_camera_calibration(
      file("height: 360\nwidth: 640\ndistortion_model: \"plumb_bob\"\nD: [0.0, 0.0, 0.0, 0.0, 0.0]\n"
           "K: [508.5, 0.0, 319.0, 0.0, 507.5, 179.5, 0.0, 0.0, 1.0]\n")));  // a message as it is printed
  expect_pinhole(vo::read_camera_calibration(file(
      "image_Width: 640\nimage_Height: 360\ncameraMatrix: [[508.5, 0, 319], [0, 507.5, 179.5], [0, 0, 1]]\n"
      "distCoeffs: [[0.1, -0.2, 0, 0, 0]]\n")));  // other spellings, and a list as Python writes it
  expect_pinhole(vo::read_camera_calibration(
      file("sensor_type: camera\nrate_hz: 20\nresolution: [640, 360]\ncamera_model: pinhole\n"
           "intrinsics: [508.5, 507.5, 319.0, 179.5] #fu, fv, cu, cv\n"
           "distortion_model: radial-tangential\n"
           "distortion_coefficients: [0.1, -0.2, 0.0, 0.0]\n")));  // EuRoC
  const vo::Camera unsized = vo::read_camera_calibration(
      file(without_line(without_line(kOrbSlam, "Camera.width"), "Camera.height")));
  EXPECT_EQ(unsized.width_px, 0);
  EXPECT_EQ(unsized.fx_px, 508.5);
}

TEST_F(CameraCalibration, IsReadAsOpenCvWritesXmlAndJson) {
  for (const char* name : {"camera.xml", "camera.json"}) {
    const auto path = folder_.path() / name;
    {
      cv::FileStorage out(path.string(), cv::FileStorage::WRITE);
      const bool old = std::string_view(name) == "camera.xml";  // the names of OpenCV's older sample
      out << (old ? "image_Width" : "image_width") << 640 << "image_height" << 360;
      out << (old ? "Camera_Matrix" : "camera_matrix")
          << cv::Mat(cv::Matx33d(508.5, 0, 319, 0, 507.5, 179.5, 0, 0, 1));
      out << "distortion_coefficients" << cv::Mat(cv::Matx<double, 1, 5>(0.1, -0.2, 0, 0, 0));
    }
    const vo::Camera camera = vo::read_camera_calibration(path);
    expect_pinhole(camera);
    EXPECT_THAT(camera.distortion, ElementsAre(0.1, -0.2, 0, 0, 0)) << name;
  }
}

TEST_F(CameraCalibration, KnowsFisheyes) {
  const std::string kalibr = with(kKalibr, "radtan", "equidistant");
  const std::string ros =
      with(with(kRos, "plumb_bob", "equidistant"), "0.1, -0.2, 0, 0, 0", "0.1, -0.2, 0, 0");
  const std::string orb = with(with(with(kOrbSlam, "PinHole", "KannalaBrandt8"), "p1", "k3"), "p2", "k4");
  for (const std::string& text : {kalibr, ros, orb}) {
    const vo::Camera camera = vo::read_camera_calibration(file(text));
    EXPECT_EQ(camera.lens, vo::LensModel::kEquidistant);
    EXPECT_THAT(camera.distortion, ElementsAre(0.1, -0.2, 0, 0));
  }
  EXPECT_THAT(message(file(with(kRos, "plumb_bob", "equidistant"))), HasSubstr("expected 4, of a fisheye"));
}

TEST_F(CameraCalibration, RefusesOtherModelsByName) {
  EXPECT_THAT(message(file(with(with(kKalibr, "camera_model: pinhole", "camera_model: ds"), "[508.5, 507.5,",
                                "[0.5, 0.6, 508.5, 507.5,"))),
              HasSubstr("is of the camera model 'ds'"));
  EXPECT_THAT(message(file(with(kKalibr, "radtan", "fov"))), HasSubstr("is of the camera model 'fov'"));
  EXPECT_THAT(
      message(file(with(kRos, "camera_name: head", "camera_model: double_sphere\ncamera_name: head"))),
      HasSubstr("is of the camera model 'double_sphere'"));
  EXPECT_THAT(message(file(with(kOrbSlam, "PinHole", "Omni"))), HasSubstr("is of the camera model 'omni'"));
  EXPECT_THAT(message(file(without_line(kOrbSlam, "Camera.cy"))), HasSubstr("has no Camera.cy"));
  EXPECT_THAT(message(file(with(kRos, "508.5, 0.", "0, 0."))), HasSubstr("has focal lengths 0 and 507.5"));
  EXPECT_THAT(message(file(with(kRos, "508.5, 0.", "x, 0."))), HasSubstr("camera_matrix.data is '"));
  EXPECT_THAT(message(file(with(kRos, "0.1, -0.2, 0, 0, 0", "nan, 0, 0, 0"))),
              HasSubstr("distortion_coefficients"));
}

TEST_F(CameraCalibration, TakesNoMemoryForWhatIsOnlyClaimed) {
  // A matrix of 10^10 numbers of which there are nine is a matrix of nine.
  const std::string json =
      R"({"image_width": 640, "image_height": 480, "camera_matrix": {"type_id": "opencv-matrix", "rows": 100000,)"
      R"("cols": 100000, "dt": "d", "data": [500.0, 0.0, 320.0, 0.0, 510.0, 240.0, 0.0, 0.0, 1.0]}})";
  EXPECT_EQ(vo::read_camera_calibration(file(json)).fy_px, 510);
  // What lies 100,000 deep takes no stack, and zeros among XML are no XML.
  EXPECT_THAT(message(file(std::string(100'000, '{'))), HasSubstr("is no JSON that OpenCV writes"));
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_THAT(message(file(deep)), HasSubstr("is no XML that OpenCV writes"));
  EXPECT_THAT(
      message(file("<?xml versi=" + std::string(9, '\0') + "imag\"1.0\"?>\n<opencv_storage>\n<image_w")),
      HasSubstr("is no XML that OpenCV writes"));
  EXPECT_THAT(message(file(std::string(2 << 20, '#'))), HasSubstr("is 2097152 bytes long"));
  for (const char* size : {"image_width: 1e300", "image_width: -640"})
    EXPECT_NE(message(file(with(kRos, "image_width: 640", size))), "");
}

TEST_F(CameraCalibration, PassesOverKeysThatNoCalibrationHas) {
  std::string text = std::string(kRos) + "\n" + std::string(100, 'k') + ":\n";
  text += " image_width: 1\n";
  EXPECT_EQ(vo::read_camera_calibration(file(text)).width_px, 640);
}

}  // namespace
