#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <place/trajectory/drift_correction.hpp>
#include <vo/base/rng.hpp>
#include <vo/base/trajectory.hpp>

namespace test_support {

/// How a walk's odometry goes wrong.
struct Drift {
  double step_scale = 1;      ///< measured over true
  double turn_scale = 1;      ///< measured over true
  double bias_rad_per_m = 0;  ///< turns measured where there are none
  double step_noise_m = 0;    ///< per sqrt(m)
  double turn_noise_rad = 0;  ///< per sqrt(m)
};

inline vo::Pose2 advance(const vo::Pose2& pose, double forward_m, double turn_rad) {
  const double middle = pose.heading_rad + turn_rad / 2;
  return {pose.x_m + forward_m * std::sin(middle), pose.y_m + forward_m * std::cos(middle),
          vo::wrap_angle_rad(pose.heading_rad + turn_rad)};
}

/// Straight legs of 12 m and corners of 90 degrees taken over 2 m, right and left at random; a node every
/// `spacing_m`, two a second.
inline vo::Trajectory walk_round_corners(std::size_t nodes, std::uint64_t seed, double spacing_m = 0.5) {
  vo::Rng rng(seed);
  vo::Trajectory truth{{0, {}}};
  double left_m = 12, turn_rad_per_m = 0;
  while (truth.size() < nodes) {
    if (left_m <= 0) {
      const bool straight = turn_rad_per_m != 0;
      left_m = straight ? 12 : 2;
      turn_rad_per_m = straight ? 0 : (rng.index(2) == 0 ? 1 : -1) * std::numbers::pi / 4;
    }
    truth.push_back(
        {truth.back().time_s + 0.5, advance(truth.back().pose, spacing_m, turn_rad_per_m * spacing_m)});
    left_m -= spacing_m;
  }
  return truth;
}

/// The walk as odometry that drifts so sees it, from (0, 0) with heading 0.
inline vo::Trajectory drifted(const vo::Trajectory& truth, const Drift& drift, std::uint64_t seed = 1) {
  vo::Rng rng(seed);
  vo::Trajectory odometry{{truth.front().time_s, {}}};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const vo::Pose2 &a = truth[i - 1].pose, &b = truth[i].pose;
    const double moved_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), root_m = std::sqrt(moved_m);
    const double turn_rad = vo::wrap_angle_rad(b.heading_rad - a.heading_rad);
    odometry.push_back(
        {truth[i].time_s, advance(odometry.back().pose,
                                  drift.step_scale * moved_m + drift.step_noise_m * root_m * rng.normal(),
                                  drift.turn_scale * turn_rad + drift.bias_rad_per_m * moved_m +
                                      drift.turn_noise_rad * root_m * rng.normal())});
  }
  return odometry;
}

/// Fixes at every `every`-th node: the true pose, moved by normal errors along and across the way.
inline std::vector<place::PoseFix> fixes_of(const vo::Trajectory& truth, std::size_t every,
                                            double along_sd_m = 0, double across_sd_m = 0,
                                            std::uint64_t seed = 1) {
  vo::Rng rng(seed);
  std::vector<place::PoseFix> fixes;
  for (std::size_t i = 0; i < truth.size(); i += every) {
    vo::Pose2 pose = truth[i].pose;
    const double along_m = along_sd_m * rng.normal(), right_m = across_sd_m * rng.normal();
    const double s = std::sin(pose.heading_rad), c = std::cos(pose.heading_rad);
    pose.x_m += along_m * s + right_m * c;
    pose.y_m += along_m * c - right_m * s;
    fixes.push_back({.node = i, .pose = pose, .score = 3});
  }
  return fixes;
}

/// Replaces about a share of the fixes by poses from anywhere on the walk; returns which.
inline std::vector<bool> replace_at_random(std::vector<place::PoseFix>& fixes, const vo::Trajectory& truth,
                                           double share, std::uint64_t seed) {
  vo::Rng rng(seed);
  std::vector<bool> replaced;
  for (place::PoseFix& fix : fixes) {
    replaced.push_back(rng.uniform() < share);
    if (replaced.back()) fix.pose = truth[rng.index(truth.size())].pose;
  }
  return replaced;
}

inline double distance_m(const vo::Pose2& a, const vo::Pose2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/// Root mean square distance of poses of the same nodes.
template <typename Poses>
double rmse_m(const Poses& poses, const vo::Trajectory& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) sum += std::pow(distance_m(poses[i].pose, truth[i].pose), 2);
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

}  // namespace test_support
