#include "place/trajectory/fixed_lag.hpp"

#include "trajectory/constraints.hpp"
#include "trajectory/initial_alignment.hpp"
#include "trajectory/pose_graph.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace place {

using pose_graph::Constraint;
using pose_graph::State;

struct FixedLagCorrector::Window {
  FixedLagOptions options;
  bool placed = false;
  vo::Trajectory odometry;
  std::vector<PoseFix> fixes;  // for the alignment, until the walk is placed
  pose_graph::Graph graph;     // states once the walk is placed
  double since_fix_m = 0;      // since the last fix

  void add(const vo::TimedPose& node, const std::optional<PoseFix>& fix) {
    if (!odometry.empty()) {
      graph.motions.push_back(pose_graph::motion_between(odometry.back().pose, node.pose));
      since_fix_m += graph.motions.back().distance_m;
      if (placed) graph.states.push_back(pose_graph::predicted(graph.states.back(), graph.motions.back()));
    }
    odometry.push_back(node);
    if (!fix) return;
    // The new information since the last fix: later ones are not known yet.
    const double share =
        graph.fixes.empty() ? 1 : std::min(1.0, since_fix_m / options.drift.match_correlation_m);
    since_fix_m = 0;
    graph.fixes.push_back({.node = odometry.size() - 1,
                           .pose = fix->pose,
                           .sigma_m = match_sd_m(*fix, options.drift),
                           .aside_m = fix->aside_sd_m.value_or(options.drift.aside_m),
                           .share = std::max(share, 1e-3)});
    if (!placed) fixes.push_back({.node = odometry.size() - 1, .pose = fix->pose, .score = fix->score});
  }

  /// Places the walk so far on the map, if matches agree.
  void try_to_place() {
    graph.states = initial_alignment(odometry, travelled_by_node_m(odometry), fixes);
    placed = !graph.states.empty();
    if (!placed) return;
    graph.prior = pose_graph::prior_at_start(graph.states.front(), false, options.drift);
    fixes.clear();
    pose_graph::solve(graph, options.drift);
  }

  UncertainPose pose_at(std::size_t node, const Eigen::Matrix3d& covariance) const {
    return uncertain_pose(odometry[node].time_s, graph.states[node], covariance, true, options.drift);
  }

  /// Removes nodes from the front until `lag` are left.
  std::vector<UncertainPose> release() {
    std::vector<UncertainPose> poses;
    if (odometry.size() <= options.lag) return poses;
    const std::vector<Eigen::Matrix3d> covariances = pose_graph::covariances(graph, options.drift);
    const std::size_t count = odometry.size() - options.lag;
    for (std::size_t i = 0; i < count; ++i) {
      poses.push_back(pose_at(0, covariances[i]));
      graph.prior = pose_graph::prior_after_first(graph, options.drift);
      graph.states.erase(graph.states.begin());
      graph.motions.erase(graph.motions.begin());
      odometry.erase(odometry.begin());
      std::erase_if(graph.fixes, [](const Constraint& fix) { return fix.node == 0; });
      for (Constraint& fix : graph.fixes) --fix.node;
    }
    return poses;
  }
};

FixedLagCorrector::FixedLagCorrector(const FixedLagOptions& options) : window_(std::make_unique<Window>()) {
  if (std::string reason; !options.drift.is_valid(&reason))
    throw std::invalid_argument("FixedLagCorrector: " + reason);
  if (options.lag < 2) throw std::invalid_argument("FixedLagCorrector: lag must be 2 or more");
  window_->options = options;
}

FixedLagCorrector::~FixedLagCorrector() = default;
FixedLagCorrector::FixedLagCorrector(FixedLagCorrector&&) noexcept = default;
FixedLagCorrector& FixedLagCorrector::operator=(FixedLagCorrector&&) noexcept = default;

std::vector<UncertainPose> FixedLagCorrector::push(const vo::TimedPose& odometry,
                                                   const std::optional<PoseFix>& fix) {
  // Old fixes are nearly sorted into right and wrong; new ones are a step of odometry away.
  constexpr double kMostConvex = 16;
  Window& window = *window_;
  window.add(odometry, fix);
  if (fix && !window.placed) {
    window.try_to_place();
  } else if (fix) {
    pose_graph::solve(window.graph, window.options.drift, kMostConvex);
  }
  return window.placed ? window.release() : std::vector<UncertainPose>{};
}

std::optional<UncertainPose> FixedLagCorrector::latest() const {
  if (!window_->placed) return std::nullopt;
  return window_->pose_at(window_->odometry.size() - 1,
                          pose_graph::covariances(window_->graph, window_->options.drift).back());
}

std::vector<UncertainPose> FixedLagCorrector::finish() {
  std::vector<UncertainPose> poses;
  if (!window_->placed) return poses;
  const std::vector<Eigen::Matrix3d> covariances =
      pose_graph::covariances(window_->graph, window_->options.drift);
  for (std::size_t i = 0; i < covariances.size(); ++i) poses.push_back(window_->pose_at(i, covariances[i]));
  return poses;
}

}  // namespace place
