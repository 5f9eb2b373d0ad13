#include "place/trajectory/drift_correction.hpp"

#include "trajectory/constraints.hpp"
#include "trajectory/initial_alignment.hpp"
#include "trajectory/pose_graph.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace place {
namespace {

void check(const vo::Trajectory& odometry, std::span<const PoseFix> fixes, std::span<const LoopClosure> loops,
           const DriftCorrectionOptions& options) {
  if (std::string reason; !options.is_valid(&reason)) throw std::invalid_argument("correct_drift: " + reason);
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    if (fixes[i].node >= odometry.size() || (i > 0 && fixes[i].node <= fixes[i - 1].node))
      throw std::invalid_argument("correct_drift: fixes by increasing node, of the odometry, expected");
  }
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].node >= odometry.size() || loops[i].earlier >= loops[i].node ||
        (i > 0 && loops[i].node <= loops[i - 1].node))
      throw std::invalid_argument(
          "correct_drift: loops by increasing node, of the odometry, each to an earlier one, expected");
  }
}

}  // namespace

bool DriftCorrectionOptions::is_valid(std::string* reason) const {
  std::string unheard;
  if (reason == nullptr) reason = &unheard;
  const std::array<std::pair<const char*, double>, 16> above{{{"step_scale_sd", step_scale_sd},
                                                              {"step_scale_walk", step_scale_walk},
                                                              {"turn_scale_sd", turn_scale_sd},
                                                              {"turn_scale_walk", turn_scale_walk},
                                                              {"bias_sd_rad_per_m", bias_sd_rad_per_m},
                                                              {"bias_walk_rad_per_m", bias_walk_rad_per_m},
                                                              {"step_noise_m", step_noise_m},
                                                              {"side_noise_m", side_noise_m},
                                                              {"turn_noise_rad", turn_noise_rad},
                                                              {"match_least_m", match_least_m},
                                                              {"match_score", match_score},
                                                              {"aside_m", aside_m},
                                                              {"match_heading_rad", match_heading_rad},
                                                              {"match_correlation_m", match_correlation_m},
                                                              {"outlier_chi2", outlier_chi2},
                                                              {"node_noise_rad", node_noise_rad}}};
  for (const auto& [name, value] : above)
    if (!(value > 0)) return *reason = fmt::format("{} is {}; expected > 0", name, value), false;
  const std::array<std::pair<const char*, double>, 4> no_less{{{"node_noise_m", node_noise_m},
                                                               {"match_doubtful_m", match_doubtful_m},
                                                               {"steady_along_m", steady_along_m},
                                                               {"steady_aside_m", steady_aside_m}}};
  for (const auto& [name, value] : no_less)
    if (!(value >= 0)) return *reason = fmt::format("{} is {}; expected >= 0", name, value), false;
  return true;
}

CorrectedWalk correct_drift(const vo::Trajectory& odometry, std::span<const PoseFix> fixes,
                            std::span<const LoopClosure> loops, const DriftCorrectionOptions& options,
                            std::span<const std::size_t> gaps) {
  check(odometry, fixes, loops, options);
  if (!std::ranges::is_sorted(gaps)) throw std::invalid_argument("correct_drift: gaps in order expected");
  CorrectedWalk walk;
  const std::vector<double> travelled_m = travelled_by_node_m(odometry, gaps);
  pose_graph::Graph graph;
  graph.states = fixes.empty() ? unaligned(odometry) : initial_alignment(odometry, travelled_m, fixes);
  if (graph.states.empty()) return walk;
  graph.motions = motions_of(odometry, gaps);
  graph.fixes = constraints_of(fixes, travelled_m, options);
  graph.loops = constraints_of(loops, travelled_m, options);
  graph.prior = pose_graph::prior_at_start(graph.states.front(), fixes.empty(), options);
  if (!pose_graph::solve(graph, options)) return walk;

  walk.status = DriftStatus::kCorrected;
  for (const auto& fix : graph.fixes) walk.fix_weight.push_back(fix.weight);
  for (const auto& loop : graph.loops) walk.loop_weight.push_back(loop.weight);
  const std::vector<Eigen::Matrix3d> covariances = pose_graph::covariances(graph, options);
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    walk.poses.push_back(
        uncertain_pose(odometry[i].time_s, graph.states[i], covariances[i], !fixes.empty(), options));
    walk.step_scale.push_back(std::exp(graph.states[i].value[pose_graph::State::kStepScale]));
    walk.turn_scale.push_back(std::exp(graph.states[i].value[pose_graph::State::kTurnScale]));
  }
  return walk;
}

vo::Trajectory corrected_between(const vo::Trajectory& odometry, std::span<const std::size_t> nodes,
                                 const CorrectedWalk& walk) {
  if (nodes.empty() || nodes.size() != walk.poses.size())
    throw std::invalid_argument("corrected_between: one node for each corrected pose expected");
  // A pose moved by a node's correction.
  const auto moved_with = [&](std::size_t node, const vo::Pose2& pose) {
    const vo::Pose2 &from = odometry[nodes[node]].pose, &to = walk.poses[node].pose;
    const double turn = to.heading_rad - from.heading_rad, s = std::sin(turn), c = std::cos(turn);
    const double x = pose.x_m - from.x_m, y = pose.y_m - from.y_m;
    return vo::Pose2{to.x_m + c * x + s * y, to.y_m + c * y - s * x,
                     vo::wrap_angle_rad(pose.heading_rad + turn)};
  };
  vo::Trajectory corrected;
  std::size_t next = 0;  // node
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const auto& [time_s, pose] = odometry[i];
    while (next + 1 < nodes.size() && i >= nodes[next]) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1;
    const vo::Pose2 a = moved_with(before, pose), b = moved_with(next, pose);
    const double from_s = odometry[nodes[before]].time_s, to_s = odometry[nodes[next]].time_s;
    const double t = to_s > from_s ? std::clamp((time_s - from_s) / (to_s - from_s), 0.0, 1.0) : 0;
    corrected.push_back(
        {time_s,
         {std::lerp(a.x_m, b.x_m, t), std::lerp(a.y_m, b.y_m, t),
          vo::wrap_angle_rad(a.heading_rad + t * vo::wrap_angle_rad(b.heading_rad - a.heading_rad))}});
  }
  return corrected;
}

}  // namespace place
