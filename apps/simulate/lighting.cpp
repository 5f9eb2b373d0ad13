#include "lighting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace simulate {
namespace {

const Eigen::Vector3d kToSun = Eigen::Vector3d(-0.5, 0.45, 0.74).normalized();
constexpr double kLightGrid_m = 0.5;
constexpr double kLampReach_m = 25;       // beyond it a lamp adds less than one grey level
constexpr double kLampReference_m2 = 20;  // a lamp's brightness is given at 4 m

cv::Mat4b with_glow_and_alpha(const cv::Mat& lit, const Painting& painting, bool glowing) {
  cv::Mat bgr = lit;
  if (glowing && !painting.glow.empty()) bgr = lit + painting.glow;
  cv::Mat alpha = painting.alpha;
  if (alpha.empty()) alpha = cv::Mat(lit.size(), CV_8U, cv::Scalar(255));
  cv::Mat4b result(lit.size());
  cv::merge(std::vector<cv::Mat>{bgr, alpha}, result);
  return result;
}

}  // namespace

Lighting::Lighting(Scene scene, Condition condition, std::vector<Lamp> lamps)
    : condition_(condition), lamps_(std::move(lamps)) {
  const bool outdoors = scene == Scene::kStreet;
  // Blue, green, red. The sun's and the sky's shares add up to about 1 on a sunlit wall.
  switch (condition) {
    case Condition::kDay:
      ambient_ = outdoors ? cv::Vec3f(0.66F, 0.60F, 0.56F) : cv::Vec3f(0.62F, 0.62F, 0.62F);
      sun_ = outdoors ? cv::Vec3f(0.36F, 0.46F, 0.52F) : cv::Vec3f(0, 0, 0);
      if (outdoors) haze_ = {{225, 210, 200}, 500};
      break;
    case Condition::kNight:
      // Moon and sky glow are bluish and so weak that what no lamp reaches all but drowns in the noise.
      ambient_ = outdoors ? cv::Vec3f(0.11F, 0.08F, 0.07F) : cv::Vec3f(0.10F, 0.11F, 0.12F);
      sun_ = {0, 0, 0};
      break;
    case Condition::kRain:
      ambient_ = outdoors ? cv::Vec3f(0.70F, 0.66F, 0.62F) : cv::Vec3f(0.55F, 0.52F, 0.50F);
      sun_ = {0, 0, 0};
      // 40 m is a visibility of about 160 m (contrast 2 %): fog by the meteorologist's definition.
      if (outdoors) haze_ = {{175, 170, 166}, 40};
      break;
  }
}

cv::Vec3f Lighting::at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  const bool all_round = normal.isZero();
  // Sky and ground light a wall by halves; less of it reaches the foot of a wall.
  const double openness = 0.75 + 0.25 * std::clamp(point.z() / 2.0, 0.0, 1.0);
  cv::Vec3f light = ambient_ * (all_round ? 1.0 : normal.z() > 0.5 ? 1.0 : openness);
  light += sun_ * (all_round ? 0.6 : std::max(0.0, normal.dot(kToSun)) * 1.4);
  if (condition_ == Condition::kRain) return light;
  for (const Lamp& lamp : lamps_) {
    const Eigen::Vector3d to_lamp = lamp.position - point;
    const double distance = to_lamp.norm();
    if (distance > kLampReach_m) continue;
    const double facing = all_round ? 0.6 : std::max(0.0, normal.dot(to_lamp) / distance);
    // A lamp is no point: the 4 m2 keep what is right beside it from burning out.
    light += lamp.bgr * (facing * kLampReference_m2 / (4 + distance * distance));
  }
  return light;
}

cv::Mat4b bake(const Painting& painting, const Surface& surface, const Lighting& lighting) {
  const Eigen::Vector3d normal = painting.alpha.empty()
                                     ? Eigen::Vector3d(surface.down.cross(surface.across).normalized())
                                     : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const int columns = std::max(1, static_cast<int>(surface.across.norm() / kLightGrid_m));
  const int rows = std::max(1, static_cast<int>(surface.down.norm() / kLightGrid_m));
  cv::Mat3f grid(rows, columns);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Eigen::Vector3d point =
          surface.corner + surface.across * ((x + 0.5) / columns) + surface.down * ((y + 0.5) / rows);
      grid(y, x) = lighting.at(point, normal);
    }
  }
  cv::Mat light;
  cv::resize(grid, light, painting.colour.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat lit;
  cv::multiply(painting.colour, light, lit, 1, CV_8U);
  return with_glow_and_alpha(lit, painting, lighting.night());
}

cv::Mat4b bake_evenly(const Painting& painting, const cv::Vec3f& light) {
  cv::Mat lit;
  cv::multiply(painting.colour, cv::Scalar(light[0], light[1], light[2]), lit, 1, CV_8U);
  return with_glow_and_alpha(lit, painting, false);
}

}  // namespace simulate
