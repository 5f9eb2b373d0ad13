#include "vo/base/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vo {

double wrap_angle_rad(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

namespace {

double distance_m(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

}  // namespace

void head_along_path(Trajectory& trajectory, double reach_m) {
  if (trajectory.empty()) return;
  // Marks along the path, each the first pose half the reach away from the mark before; and the last pose.
  std::vector<std::size_t> mark{0};
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (distance_m(trajectory[mark.back()].pose, trajectory[i].pose) >= reach_m / 2) mark.push_back(i);
  }
  if (mark.back() + 1 < trajectory.size()) mark.push_back(trajectory.size() - 1);
  double heading_rad = 0;
  std::size_t next = 0;  // the first mark at or after the pose
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (mark[next] < i) ++next;
    const Pose2& here = trajectory[i].pose;
    const auto far = [&](std::size_t m) { return distance_m(here, trajectory[mark[m]].pose) >= reach_m / 2; };
    // The mark before a pose may be nearer than half the reach; the one before that, rarely so.
    std::size_t from = mark[next] == i || next == 0 ? next : next - 1, to = next;
    for (int k = 0; k < 2 && from > 0 && !far(from); ++k) --from;
    for (int k = 0; k < 2 && to + 1 < mark.size() && !far(to); ++k) ++to;
    const Pose2 &a = trajectory[mark[from]].pose, &b = trajectory[mark[to]].pose;
    if (distance_m(a, b) > 0) heading_rad = std::atan2(b.x_m - a.x_m, b.y_m - a.y_m);
    trajectory[i].pose.heading_rad = heading_rad;
  }
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
