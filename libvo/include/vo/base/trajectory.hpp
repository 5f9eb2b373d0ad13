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

/// The angle wrapped to (-pi, pi].
double wrap_angle_rad(double angle_rad);

}  // namespace vo
