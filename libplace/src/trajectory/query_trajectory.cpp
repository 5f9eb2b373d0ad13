#include "place/trajectory/query_trajectory.hpp"

#include "place/trajectory/pose_fixes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace place {
namespace {

/// The trajectory moved rigidly so that it begins at a pose.
vo::Trajectory laid_at(const vo::Pose2& begin, vo::Trajectory trajectory) {
  const vo::Pose2 from = trajectory.front().pose;
  const double turn = begin.heading_rad - from.heading_rad, s = std::sin(turn), c = std::cos(turn);
  for (auto& [time_s, pose] : trajectory) {
    const double x = pose.x_m - from.x_m, y = pose.y_m - from.y_m;
    pose = {begin.x_m + c * x + s * y, begin.y_m + c * y - s * x,
            vo::wrap_angle_rad(pose.heading_rad + turn)};
  }
  return trajectory;
}

}  // namespace

std::size_t matches_believed(const QueryTrajectory& trajectory) {
  constexpr double kHalf = 0.5;  // a match that has lost this share of its weight counts as rejected
  return static_cast<std::size_t>(
      std::ranges::count_if(trajectory.corrected.fix_weight, [](double weight) { return weight >= kHalf; }));
}

QueryTrajectory query_trajectory(const Route& route, const std::vector<Match>& matches,
                                 const vo::Trajectory& odometry, std::span<const std::size_t> gaps) {
  if (odometry.size() != matches.size())
    throw std::invalid_argument("query_trajectory: a pose for each match expected");
  RouteFixes fixes = pose_fixes(route, matches);
  QueryTrajectory t;
  t.traverse = fixes.traverse;
  t.fixes = std::move(fixes.fixes);
  if (!t.fixes.empty()) t.corrected = correct_drift(odometry, t.fixes, {}, {}, gaps);
  if (t.corrected.status != DriftStatus::kCorrected) {
    t.why_not = "fewer than three accepted matches agree with the walk between them";
    return t;
  }
  // With three of ten matches replaced by random ones, at least three of five still agree and the trajectory
  // is right; of random ones alone, a twentieth agree.
  if (const std::size_t believed = matches_believed(t); 3 * believed < t.fixes.size()) {
    t.why_not = fmt::format("only {} of {} accepted matches agree with the walk's steps and turns", believed,
                            t.fixes.size());
    return t;
  }
  t.odometry = laid_at(t.corrected.poses.front().pose, odometry);
  std::vector<vo::Pose2> poses;
  for (const UncertainPose& pose : t.corrected.poses) poses.push_back(pose.pose);
  t.on_route = positions_on_route(route.traverses[*t.traverse], poses);
  return t;
}

}  // namespace place
