#pragma once

#include <opencv2/core/matx.hpp>

namespace vo {

/// A pose in space: a point of the body is at `rotation * point + position` in the world (world_from_body).
/// Camera axes are x right, y down, z forward.
struct Pose3 {
  cv::Matx33d rotation = cv::Matx33d::eye();
  cv::Vec3d position{0, 0, 0};
};

/// a_from_c = a_from_b * b_from_c.
Pose3 compose(const Pose3& a_from_b, const Pose3& b_from_c);

/// b_from_a.
Pose3 inverse(const Pose3& a_from_b);

/// The pose at a share `t` of the way from one to the other: linear, and along the shorter arc.
Pose3 interpolate(const Pose3& from, const Pose3& to, double t);

/// The angle of a rotation, in [0, pi].
double angle_rad(const cv::Matx33d& rotation);

}  // namespace vo
