#include "vo/io/camera_calibration.hpp"

#include "vo/base/error.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>
#include <opencv2/core.hpp>

namespace vo {
namespace {

constexpr std::string_view kForm = "a camera calibration of OpenCV: image_width, image_height, camera_matrix";

cv::Mat matrix(const cv::FileStorage& file, const std::string& name) {
  cv::Mat values;
  file[name] >> values;
  if (!values.empty()) values.convertTo(values, CV_64F);
  return values;
}

}  // namespace

Camera read_camera_calibration(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (!std::filesystem::exists(path)) throw Error(name, "does not exist", kForm);
  try {
    const cv::FileStorage file(name, cv::FileStorage::READ);
    if (!file.isOpened()) throw Error(name, "cannot be read", kForm);
    Camera camera;
    file["image_width"] >> camera.width_px;
    file["image_height"] >> camera.height_px;
    if (camera.width_px < 1 || camera.height_px < 1)
      throw Error(name, "has no image_width and image_height", kForm);
    const cv::Mat k = matrix(file, "camera_matrix");
    if (k.size() != cv::Size(3, 3)) throw Error(name, "has no 3x3 camera_matrix", kForm);
    camera.fx_px = k.at<double>(0, 0);
    camera.fy_px = k.at<double>(1, 1);
    camera.cx_px = k.at<double>(0, 2);
    camera.cy_px = k.at<double>(1, 2);
    if (!(camera.fx_px > 0) || !(camera.fy_px > 0)) {
      throw Error(name, fmt::format("has focal lengths {} and {}", camera.fx_px, camera.fy_px),
                  "pixels, above 0");
    }
    const cv::Mat distortion = matrix(file, "distortion_coefficients");
    constexpr std::array<std::size_t, 6> kCounts{0, 4, 5, 8, 12, 14};
    if (std::ranges::find(kCounts, distortion.total()) == kCounts.end()) {
      throw Error(name, fmt::format("has {} distortion_coefficients", distortion.total()),
                  "0, 4, 5, 8, 12 or 14");
    }
    if (!distortion.empty()) camera.distortion.assign(distortion.begin<double>(), distortion.end<double>());
    return camera;
  } catch (const cv::Exception&) {
    throw Error(name, "is no YAML, XML or JSON that OpenCV reads", kForm);
  }
}

}  // namespace vo
