#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include <vo/base/rng.hpp>
#include <vo/geometry/camera.hpp>
#include <vo/tracks/tracking_window.hpp>

namespace test_support {

/// How a camera moves between two views, in its own axes: x right, y down, z forward.
struct CameraMove {
  double turn_rad = 0;   ///< to the right, about the vertical
  double pitch_rad = 0;  ///< up
  double roll_rad = 0;   ///< clockwise as seen by the walker
  Eigen::Vector3d travel_m{0, 0, 0};
};

/// A point in space, in the axes of the first view, for a seeded generator.
using ScenePoint = std::function<Eigen::Vector3d(vo::Rng&)>;

/// Points within the view, 3 to 30 m off.
inline Eigen::Vector3d anywhere(vo::Rng& rng) {
  const double z_m = rng.uniform(3, 30);
  return {z_m * rng.uniform(-0.6, 0.6), z_m * rng.uniform(-0.35, 0.35), z_m};
}

/// `count` points seen in both views, exact to the float that a feature holds plus `noise_px` of normal
/// noise.
inline std::vector<vo::TrackedPoint> tracked_points(const vo::Camera& camera, const CameraMove& move,
                                                    int count, const ScenePoint& scene = anywhere,
                                                    double noise_px = 0, std::uint64_t seed = 1) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  // Axes of the second camera in those of the first. Turning right takes z towards x.
  const Eigen::Matrix3d second =
      (AngleAxisd(move.turn_rad, Vector3d::UnitY()) * AngleAxisd(move.pitch_rad, Vector3d::UnitX()) *
       AngleAxisd(move.roll_rad, Vector3d::UnitZ()))
          .toRotationMatrix();
  vo::Rng rng(seed);
  std::vector<vo::TrackedPoint> points;
  const auto pixel = [&](const Vector3d& p) {
    vo::Feature feature;
    feature.x_px = static_cast<float>(camera.cx_px + camera.fx_px * p.x() / p.z() + noise_px * rng.normal());
    feature.y_px = static_cast<float>(camera.cy_px + camera.fy_px * p.y() / p.z() + noise_px * rng.normal());
    return feature;
  };
  const auto seen = [&](const vo::Feature& f) {
    return f.x_px >= 0 && f.x_px < static_cast<float>(camera.width_px) && f.y_px >= 0 &&
           f.y_px < static_cast<float>(camera.height_px);
  };
  while (points.size() < static_cast<std::size_t>(count)) {
    const Vector3d first = scene(rng);
    const Vector3d then = second.transpose() * (first - move.travel_m);
    if (first.z() < 0.5 || then.z() < 0.5) continue;
    const vo::TrackedPoint point{pixel(first), pixel(then)};
    if (seen(point.from) && seen(point.to)) points.push_back(point);
  }
  return points;
}

}  // namespace test_support
