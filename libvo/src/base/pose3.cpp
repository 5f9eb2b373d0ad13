#include "vo/base/pose3.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <opencv2/core/eigen.hpp>

namespace vo {
namespace {

Eigen::Quaterniond quaternion(const cv::Matx33d& rotation) {
  Eigen::Matrix3d matrix;
  cv::cv2eigen(rotation, matrix);
  return Eigen::Quaterniond(matrix);
}

}  // namespace

Pose3 compose(const Pose3& a_from_b, const Pose3& b_from_c) {
  return {.rotation = a_from_b.rotation * b_from_c.rotation,
          .position = a_from_b.rotation * b_from_c.position + a_from_b.position};
}

Pose3 inverse(const Pose3& a_from_b) {
  const cv::Matx33d rotation = a_from_b.rotation.t();
  return {.rotation = rotation, .position = -(rotation * a_from_b.position)};
}

Pose3 interpolate(const Pose3& from, const Pose3& to, double t) {
  Pose3 pose{.position = from.position * (1 - t) + to.position * t};
  const Eigen::Quaterniond q = quaternion(from.rotation).slerp(t, quaternion(to.rotation));
  cv::eigen2cv(Eigen::Matrix3d(q.toRotationMatrix()), pose.rotation);
  return pose;
}

double angle_rad(const cv::Matx33d& rotation) {
  const cv::Vec3d twice_sine(rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0),
                             rotation(1, 0) - rotation(0, 1));
  return std::atan2(cv::norm(twice_sine), cv::trace(rotation) - 1);
}

}  // namespace vo
