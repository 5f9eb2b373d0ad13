#include "vo/base/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vo {

double wrap_angle_rad(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

std::optional<Pose2> pose_at(const Trajectory& trajectory, double time_s, double tolerance_s) {
  if (trajectory.empty()) return std::nullopt;
  if (time_s < trajectory.front().time_s - tolerance_s) return std::nullopt;
  if (time_s > trajectory.back().time_s + tolerance_s) return std::nullopt;
  const auto after = std::ranges::lower_bound(trajectory, time_s, {}, &TimedPose::time_s);
  if (after == trajectory.begin()) return trajectory.front().pose;
  if (after == trajectory.end()) return trajectory.back().pose;

  const TimedPose& a = *std::prev(after);
  const TimedPose& b = *after;
  const double t = (time_s - a.time_s) / (b.time_s - a.time_s);
  return Pose2{.x_m = std::lerp(a.pose.x_m, b.pose.x_m, t),
               .y_m = std::lerp(a.pose.y_m, b.pose.y_m, t),
               .heading_rad = wrap_angle_rad(a.pose.heading_rad +
                                             t * wrap_angle_rad(b.pose.heading_rad - a.pose.heading_rad))};
}

}  // namespace vo
