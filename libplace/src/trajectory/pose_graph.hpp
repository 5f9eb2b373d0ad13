#pragma once

#include "place/trajectory/drift_correction.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

/// The graph behind `correct_drift` and `FixedLagCorrector`. Ceres stays in the source file.
namespace place::pose_graph {

/// What is solved for at every node. Headings are not wrapped, so that they differ as the walker turned.
struct State {
  enum Index { kX, kY, kHeading, kStepScale, kBias, kTurnScale, kCount };
  /// metres, metres, radians; log of true over measured step, radians per metre, log of true over measured
  /// turn
  std::array<double, kCount> value{};
};

/// Odometry from one node to the next, seen from the mean of both headings.
struct Motion {
  double forward_m = 0, right_m = 0, turn_rad = 0;
  double distance_m = 0;  ///< between the two
};

/// A fix or a loop closure as the solver sees it.
struct Constraint {
  std::size_t node = 0;
  std::size_t earlier = 0;  ///< of a loop: the node that saw the same place; of a fix unused
  vo::Pose2 pose;           ///< of a fix
  double sigma_m = 1;       ///< along the path
  double share = 1;         ///< of its information that is not told by its neighbours as well
  double weight = 1;        ///< how far it is believed, set by `solve`
};

/// What is known of the first node: (state - mean)' information (state - mean).
struct Prior {
  Eigen::Matrix<double, State::kCount, 1> mean = Eigen::Matrix<double, State::kCount, 1>::Zero();
  Eigen::Matrix<double, State::kCount, State::kCount> information =
      Eigen::Matrix<double, State::kCount, State::kCount>::Zero();
};

/// States by node, motions between them.
struct Graph {
  std::vector<State> states;
  std::vector<Motion> motions;  ///< one less than states
  std::vector<Constraint> fixes;
  std::vector<Constraint> loops;
  Prior prior;
};

/// The motions between poses of odometry.
Motion motion_between(const vo::Pose2& from, const vo::Pose2& to);

/// Where the next node is, by odometry and the scales known so far.
State predicted(const State& state, const Motion& motion);

/// The prior of a walk's beginning: step length and turns as measured but for the options' spread, and a
/// pose known not at all, or exactly.
Prior prior_at_start(const State& state, bool pose_known, const DriftCorrectionOptions& options);

/// Solves for the states by graduated non-convexity (Yang et al. 2020, Geman-McClure) from those given, and
/// sets the weights. `most_convex`: mu to begin at, or less where no constraint is that far off. Returns
/// false if Ceres found no finite solution; states are then what they were.
bool solve(Graph& graph, const DriftCorrectionOptions& options, double most_convex = 1024);

/// Covariance of x, y and heading at each node, of the graph linearised at its states. Linear in nodes for a
/// chain with fixes; loops add what they tie together.
std::vector<Eigen::Matrix3d> covariances(const Graph& graph, const DriftCorrectionOptions& options);

/// What the graph's first node, with its fixes, says of the second: the prior of the graph without it. The
/// graph has two nodes or more, and no loops.
Prior prior_after_first(const Graph& graph, const DriftCorrectionOptions& options);

}  // namespace place::pose_graph
