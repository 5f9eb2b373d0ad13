#pragma once

#include <optional>
#include <vector>

#include <vo/base/pose3.hpp>
#include <vo/base/rng.hpp>
#include <vo/geometry/camera.hpp>
#include <vo/geometry/triangulation.hpp>

namespace test_support {

/// Points 3 to 15 m ahead of a camera at the origin that looks along z.
inline std::vector<cv::Vec3d> point_scene(int count, std::uint64_t seed = 1) {
  vo::Rng rng(seed);
  std::vector<cv::Vec3d> points;
  for (int i = 0; i < count; ++i) {
    const double z_m = rng.uniform(3, 15);
    points.emplace_back(z_m * rng.uniform(-0.6, 0.6), z_m * rng.uniform(-0.35, 0.35), z_m);
  }
  return points;
}

/// Where a camera sees them, with normal noise on the image plane; they must be in front of it.
inline std::vector<vo::ImagePoint> seen_by(const vo::Pose3& camera, const std::vector<cv::Vec3d>& points,
                                           double noise = 0, std::uint64_t seed = 2) {
  vo::Rng rng(seed);
  std::vector<vo::ImagePoint> seen;
  for (const cv::Vec3d& point : points) {
    const vo::ImagePoint at = vo::project(camera, point).value();
    seen.push_back({at.x + noise * rng.normal(), at.y + noise * rng.normal()});
  }
  return seen;
}

}  // namespace test_support
