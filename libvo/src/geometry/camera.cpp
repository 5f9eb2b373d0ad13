#include "vo/geometry/camera.hpp"

#include "vo/base/error.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

namespace vo {

Camera camera_from_fov(int width_px, int height_px, double fov_deg) {
  if (width_px < 1 || height_px < 1) throw std::invalid_argument("camera_from_fov: size must be positive");
  if (!(fov_deg >= 10 && fov_deg <= 170)) {
    throw std::invalid_argument("camera_from_fov: fov_deg must be in 10..170");
  }
  Camera camera{.width_px = width_px, .height_px = height_px};
  camera.fx_px = camera.fy_px = width_px / 2.0 / std::tan(fov_deg * std::numbers::pi / 360);
  camera.cx_px = (width_px - 1) / 2.0;
  camera.cy_px = (height_px - 1) / 2.0;
  return camera;
}

Camera camera_of_recording(const std::optional<Camera>& calibrated, int width_px, int height_px,
                           double fov_deg) {
  if (!calibrated) return camera_from_fov(width_px, height_px, fov_deg);
  Camera camera = *calibrated;
  if (camera.width_px == 0) {
    constexpr double kMiddle = 0.15;  // of width and height: lenses are centred to within a few hundredths
    if (std::abs(camera.cx_px / width_px - 0.5) > kMiddle ||
        std::abs(camera.cy_px / height_px - 0.5) > kMiddle) {
      throw Error("camera calibration",
                  fmt::format("does not say its size, and its principal point ({:.1f}, {:.1f}) is not in the "
                              "middle of {}x{} pixels",
                              camera.cx_px, camera.cy_px, width_px, height_px),
                  "one of the recording's size");
    }
    camera.width_px = width_px;
    camera.height_px = height_px;
  }
  if (camera.width_px == width_px && camera.height_px == height_px) return camera;
  const Camera scaled = resized(camera, width_px);
  if (std::abs(scaled.height_px - height_px) > 1) {
    throw Error("camera calibration", fmt::format("is of {}x{} pixels", camera.width_px, camera.height_px),
                fmt::format("{}x{}, as the recording, or of the same shape", width_px, height_px));
  }
  camera = scaled;
  camera.height_px = height_px;
  return camera;
}

Camera resized(const Camera& camera, int width_px) {
  const double factor = static_cast<double>(width_px) / camera.width_px;
  Camera small = camera;
  small.width_px = width_px;
  small.height_px = static_cast<int>(std::lround(camera.height_px * factor));
  small.fx_px *= factor;
  small.fy_px *= factor;
  small.cx_px = (camera.cx_px + 0.5) * factor - 0.5;
  small.cy_px = (camera.cy_px + 0.5) * factor - 0.5;
  return small;
}

std::vector<ImagePoint> undistort(const Camera& camera, const std::vector<ImagePoint>& pixels) {
  std::vector<ImagePoint> points(pixels.size());
  if (camera.distortion.empty()) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      points[i] = {(pixels[i].x - camera.cx_px) / camera.fx_px, (pixels[i].y - camera.cy_px) / camera.fy_px};
    }
    return points;
  }
  if (pixels.empty()) return points;
  const cv::Matx33d k(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  std::vector<cv::Point2d> distorted;
  for (const ImagePoint& pixel : pixels) distorted.emplace_back(pixel.x, pixel.y);
  std::vector<cv::Point2d> straight;
  if (camera.lens == LensModel::kEquidistant) {
    cv::fisheye::undistortPoints(distorted, straight, k, camera.distortion);
  } else {
    cv::undistortPoints(distorted, straight, k, camera.distortion);
  }
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {straight[i].x, straight[i].y};
  return points;
}

ImagePoint with_radial(const ImagePoint& at, double radial) {
  const double stretch = 1 + radial * (at.x * at.x + at.y * at.y);
  return {stretch * at.x, stretch * at.y};
}

ImagePoint without_radial(const ImagePoint& seen, double radial) {
  constexpr int kRounds = 6;  // each reduces the error to about 2 radial r^2 of it
  ImagePoint at = seen;
  for (int i = 0; i < kRounds; ++i) {
    const double stretch = 1 + radial * (at.x * at.x + at.y * at.y);
    at = {seen.x / stretch, seen.y / stretch};
  }
  return at;
}

}  // namespace vo
