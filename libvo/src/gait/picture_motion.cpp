#include "vo/gait/picture_motion.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace vo {

std::optional<PictureMotion> picture_motion(std::span<const TrackedPoint> points, int width_px,
                                            int height_px) {
  constexpr int kIterations = 8;
  constexpr double kTolerance = 1.5;          // of the median distance
  constexpr double kLeastDistance_px = 0.05;  // the precision of the points
  if (points.size() < 2) return std::nullopt;
  const double middle_x = (width_px - 1) / 2.0, middle_y = (height_px - 1) / 2.0;
  const double unit_px = width_px / 4.0;  // growth and roll in this unit keep the equations well scaled

  Eigen::Vector4d motion = Eigen::Vector4d::Zero();  // right, down, growth, roll
  std::vector<double> distance(points.size(), 0);
  double tolerance = 0;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right_side = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [from, to] = points[i];
      const double x = (from.x_px - middle_x) / unit_px, y = (from.y_px - middle_y) / unit_px;
      const Eigen::Vector4d row_x(1, 0, x, -y), row_y(0, 1, y, x);
      const double off = tolerance > 0 ? distance[i] / tolerance : 0;
      const double weight = 1 / (1 + off * off);
      normal.noalias() += weight * (row_x * row_x.transpose() + row_y * row_y.transpose());
      right_side += weight * (row_x * (to.x_px - from.x_px) + row_y * (to.y_px - from.y_px));
    }
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    if (solver.rcond() < 1e-9) return std::nullopt;
    motion = solver.solve(right_side);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [from, to] = points[i];
      const double x = (from.x_px - middle_x) / unit_px, y = (from.y_px - middle_y) / unit_px;
      distance[i] = std::hypot(motion[0] + motion[2] * x - motion[3] * y - (to.x_px - from.x_px),
                               motion[1] + motion[2] * y + motion[3] * x - (to.y_px - from.y_px));
    }
    tolerance = kTolerance * std::max(kLeastDistance_px, median(distance));
  }
  return PictureMotion{motion[0], motion[1], motion[2] / unit_px, motion[3] / unit_px};
}

}  // namespace vo
