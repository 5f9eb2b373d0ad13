#pragma once

#include "vo/base/pose2.hpp"

#include <optional>
#include <vector>

namespace vo {

/// A pose and when it was taken.
struct TimedPose {
  double time_s = 0;
  Pose2 pose;
};

/// Poses in order of time, strictly increasing.
using Trajectory = std::vector<TimedPose>;

/// The pose at a time, linearly interpolated in position and along the shorter arc in heading; none outside
/// the trajectory's span by more than `tolerance_s`, within it the end pose. O(log n).
std::optional<Pose2> pose_at(const Trajectory& trajectory, double time_s, double tolerance_s);

/// Metres over which the heading of a path is taken where nothing else says it: a receiver's or a tracker's
/// noise does not turn it, and a bend of a path for people is longer.
inline constexpr double kPathHeading_m = 3;

/// Gives every pose the heading of the path: from a pose at least half of `reach_m` behind to one as far
/// ahead, both taken from poses that far apart along the path, the nearest of them that are; at an end the
/// end. A path that nowhere goes so far has the heading between its ends; one that does not move keeps
/// heading 0. O(poses).
void head_along_path(Trajectory& trajectory, double reach_m);

/// The angle wrapped to (-pi, pi].
double wrap_angle_rad(double angle_rad);

}  // namespace vo
