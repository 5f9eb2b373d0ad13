#pragma once

#include "vo/base/pose3.hpp"
#include "vo/geometry/camera.hpp"

#include <optional>
#include <span>

namespace vo {

/// The position of a point that several cameras see: the one nearest to their rays (Hartley and Zisserman
/// 2004, 12.2, with rays instead of image errors). `cameras` and `seen`: one for each view, on the image
/// plane. None if the rays are nearly parallel or it lies behind a camera. Throws `std::invalid_argument`
/// unless there are as many cameras as rays, two or more. O(views).
std::optional<cv::Vec3d> triangulate(std::span<const Pose3> cameras, std::span<const ImagePoint> seen);

/// The ray to a point of the image plane, of length 1, in the world's axes.
cv::Vec3d ray_of(const Pose3& camera, const ImagePoint& seen);

/// The angle between two rays of length 1.
double angle_between_rad(const cv::Vec3d& a, const cv::Vec3d& b);

/// Where a point appears on the image plane; none behind the camera.
std::optional<ImagePoint> project(const Pose3& camera, const cv::Vec3d& point);

}  // namespace vo
