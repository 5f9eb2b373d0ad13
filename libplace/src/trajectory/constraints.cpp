#include "trajectory/constraints.hpp"

#include <algorithm>
#include <cmath>

namespace place {
namespace {

using pose_graph::Constraint;
using pose_graph::State;

/// Sets the shares of constraints whose nodes are at these metres along the path, in order.
void share_information(std::vector<Constraint>& constraints, std::span<const double> travelled_m,
                       const DriftCorrectionOptions& options) {
  const auto at_m = [&](std::size_t i) { return travelled_m[constraints[i].node]; };
  // A match owns half of the distance to either neighbour, and nothing beyond the first and last.
  constexpr double kLeast = 1e-3;  // for many matches at one place
  const double whole_m = options.match_correlation_m;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const double before_m = i > 0 ? at_m(i) - at_m(i - 1) : whole_m;
    const double after_m = i + 1 < constraints.size() ? at_m(i + 1) - at_m(i) : whole_m;
    const double own_m = (std::min(before_m, whole_m) + std::min(after_m, whole_m)) / 2;
    constraints[i].share = std::max(own_m / whole_m, kLeast);
  }
}

}  // namespace

std::vector<double> travelled_by_node_m(const vo::Trajectory& odometry, std::span<const std::size_t> gaps) {
  constexpr double kFar_m = 1e4;
  std::vector<double> travelled_m(odometry.size(), 0);
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    const vo::Pose2 &a = odometry[i - 1].pose, &b = odometry[i].pose;
    const bool gap = std::ranges::binary_search(gaps, i);
    travelled_m[i] = travelled_m[i - 1] + (gap ? kFar_m : std::hypot(b.x_m - a.x_m, b.y_m - a.y_m));
  }
  return travelled_m;
}

std::vector<pose_graph::Motion> motions_of(const vo::Trajectory& odometry,
                                           std::span<const std::size_t> gaps) {
  std::vector<pose_graph::Motion> motions;
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    motions.push_back(pose_graph::motion_between(odometry[i - 1].pose, odometry[i].pose));
    motions.back().known = !std::ranges::binary_search(gaps, i);
  }
  return motions;
}

double match_sd_m(double score, const DriftCorrectionOptions& options) {
  return options.match_least_m +
         options.match_doubtful_m * std::exp(-std::max(score, 0.0) / options.match_score);
}

double match_sd_m(const PoseFix& fix, const DriftCorrectionOptions& options) {
  if (!fix.probability) return match_sd_m(fix.score, options);
  return std::hypot(options.match_least_m, fix.sd_m.value_or(0),
                    std::sqrt(1 - *fix.probability) * options.match_doubtful_m);
}

std::vector<Constraint> constraints_of(std::span<const PoseFix> fixes, std::span<const double> travelled_m,
                                       const DriftCorrectionOptions& options) {
  std::vector<Constraint> constraints;
  for (const PoseFix& fix : fixes)
    constraints.push_back({.node = fix.node,
                           .pose = fix.pose,
                           .sigma_m = match_sd_m(fix, options),
                           .aside_m = fix.aside_sd_m.value_or(options.aside_m)});
  share_information(constraints, travelled_m, options);
  return constraints;
}

std::vector<Constraint> constraints_of(std::span<const LoopClosure> loops,
                                       std::span<const double> travelled_m,
                                       const DriftCorrectionOptions& options) {
  std::vector<Constraint> constraints;
  for (const LoopClosure& loop : loops)
    constraints.push_back({.node = loop.node,
                           .earlier = loop.earlier,
                           .sigma_m = match_sd_m(loop.score, options),
                           .aside_m = options.aside_m});
  share_information(constraints, travelled_m, options);
  return constraints;
}

UncertainPose uncertain_pose(double time_s, const State& state, Eigen::Matrix3d covariance, bool on_map,
                             const DriftCorrectionOptions& options) {
  const double heading = state.value[State::kHeading];
  if (on_map) {
    const Eigen::Vector2d along(std::sin(heading), std::cos(heading));
    const Eigen::Vector2d across(std::cos(heading), -std::sin(heading));
    covariance.topLeftCorner<2, 2>() +=
        options.steady_along_m * options.steady_along_m * along * along.transpose() +
        options.steady_aside_m * options.steady_aside_m * across * across.transpose();
  }
  UncertainPose pose{.time_s = time_s,
                     .pose = {state.value[State::kX], state.value[State::kY], vo::wrap_angle_rad(heading)}};
  Eigen::Map<Eigen::Matrix3d>(pose.covariance.data()) = covariance;
  return pose;
}

}  // namespace place
