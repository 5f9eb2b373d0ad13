#include "vo/geometry/turned_view.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <opencv2/core.hpp>

namespace vo {
namespace {

cv::Matx33d matrix(const Camera& camera) {
  return {camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1};
}

bool has_focal_length(const Camera& camera) {
  return camera.fx_px > 0 && camera.fy_px > 0;
}

}  // namespace

cv::Matx33d turned_view(const Camera& from, const Camera& to, double turn_rad) {
  if (!has_focal_length(from) || !has_focal_length(to))
    throw std::invalid_argument("turned_view: cameras with focal lengths expected");
  if (!(std::abs(turn_rad) < std::numbers::pi / 2))
    throw std::invalid_argument("turned_view: a turn of less than a right angle expected");
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  const cv::Matx33d to_from_from(c, 0, -s, 0, 1, 0, s, 0, c);  // x right, y down, z ahead
  return matrix(to) * to_from_from * matrix(from).inv();
}

}  // namespace vo
