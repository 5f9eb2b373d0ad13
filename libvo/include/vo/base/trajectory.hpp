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

/// Metres over which the heading of a path is measured where nothing else gives it: long enough that the
/// noise of a receiver or a tracker does not turn it, and shorter than the bends of footpaths.
inline constexpr double kPathHeading_m = 3;

/// Gives every pose the heading of the path around it: the direction from the nearest pose at least half of
/// `reach_m` behind it along the path to the nearest one as far ahead; near an end, from or to that end. A
/// path shorter than that has the heading between its ends everywhere; one that does not move keeps heading
/// 0. O(poses).
void head_along_path(Trajectory& trajectory, double reach_m);

/// The angle wrapped to (-pi, pi].
double wrap_angle_rad(double angle_rad);

}  // namespace vo
