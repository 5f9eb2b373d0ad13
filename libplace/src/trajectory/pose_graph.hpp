#pragma once

#include "place/trajectory/drift_correction.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

/// The graph behind `correct_drift` and `FixedLagCorrector`. Ceres stays in the source file.
namespace place::pose_graph {

/// The unknowns at every node. Headings are not wrapped, so that their differences are the walker's turns.
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
  bool known = true;      ///< false over a gap of the recording, in which the walker may have gone anywhere
};

/// A fix or a loop closure in the solver.
struct Constraint {
  std::size_t node = 0;
  std::size_t earlier = 0;  ///< for a loop, the earlier node at the same place; unused for a fix
  vo::Pose2 pose;           ///< of a fix
  double sigma_m = 1;       ///< along the path
  double aside_m = 1;       ///< across it
  double share = 1;         ///< share of its information that its neighbours do not repeat
  double weight = 1;        ///< how much it is trusted, set by `solve`
};

/// Prior of the first node: (state - mean)' information (state - mean).
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

/// The next node's place, from odometry and the scales known so far.
State predicted(const State& state, const Motion& motion);

/// The prior of a walk's beginning: step length and turns as measured, with the options' spread, and a pose
/// that is unknown or exact.
Prior prior_at_start(const State& state, bool pose_known, const DriftCorrectionOptions& options);

/// Solves for the states by graduated non-convexity (Yang et al. 2020, Geman-McClure) from those given, and
/// sets the weights. `most_convex`: initial mu, or less if no constraint is that far off. Returns false if
/// Ceres found no finite solution; states are then unchanged.
bool solve(Graph& graph, const DriftCorrectionOptions& options, double most_convex = 1024);

/// Covariance of x, y and heading at each node, of the graph linearised at its states. Linear in nodes for a
/// chain with fixes; loops add the entries they connect.
std::vector<Eigen::Matrix3d> covariances(const Graph& graph, const DriftCorrectionOptions& options);

/// The information of the graph's first node and its fixes about the second: the prior of the graph without
/// the first. The graph has two nodes or more, and no loops.
Prior prior_after_first(const Graph& graph, const DriftCorrectionOptions& options);

}  // namespace place::pose_graph
