#include "vo/geometry/triangulation.hpp"

#include <cmath>
#include <stdexcept>

#include <opencv2/core.hpp>

namespace vo {

cv::Vec3d ray_of(const Pose3& camera, const ImagePoint& seen) {
  return camera.rotation * cv::normalize(cv::Vec3d(seen.x, seen.y, 1));
}

double angle_between_rad(const cv::Vec3d& a, const cv::Vec3d& b) {
  return std::atan2(cv::norm(a.cross(b)), a.dot(b));
}

std::optional<ImagePoint> project(const Pose3& camera, const cv::Vec3d& point) {
  const cv::Vec3d p = camera.rotation.t() * (point - camera.position);
  constexpr double kLeastDepth = 1e-6;
  if (p[2] < kLeastDepth) return std::nullopt;
  return ImagePoint{p[0] / p[2], p[1] / p[2]};
}

std::optional<cv::Vec3d> triangulate(std::span<const Pose3> cameras, std::span<const ImagePoint> seen) {
  if (cameras.size() != seen.size() || cameras.size() < 2)
    throw std::invalid_argument("triangulate: two or more cameras, a ray for each expected");
  // The sum over views of the squared distances from the ray, (I - d d') (point - position), is least where
  // these normal equations hold.
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right{0, 0, 0};
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const cv::Vec3d ray = ray_of(cameras[i], seen[i]);
    const cv::Matx33d across = cv::Matx33d::eye() - ray * ray.t();
    normal += across;
    right += across * cameras[i].position;
  }
  constexpr double kParallel = 1e-9;  // about the squared sine of the angle between two rays
  if (cv::determinant(normal) < kParallel) return std::nullopt;
  const cv::Vec3d point = normal.solve(right, cv::DECOMP_CHOLESKY);
  for (const Pose3& camera : cameras) {
    if (!project(camera, point)) return std::nullopt;
  }
  return point;
}

}  // namespace vo
