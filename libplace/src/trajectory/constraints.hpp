#pragma once

#include "place/trajectory/drift_correction.hpp"
#include "trajectory/pose_graph.hpp"

#include <span>
#include <vector>

#include <Eigen/Core>

/// From a walk and its matches to a pose graph's parts, and back.
namespace place {

/// Metres along the odometry at each node; over each of the `gaps` (nodes after one), so many that no place
/// before it is taken to be near one after it.
std::vector<double> travelled_by_node_m(const vo::Trajectory& odometry,
                                        std::span<const std::size_t> gaps = {});

/// From each node to the next; nothing is known of it over a gap.
std::vector<pose_graph::Motion> motions_of(const vo::Trajectory& odometry,
                                           std::span<const std::size_t> gaps = {});

/// Standard deviation along the path of a match of a score, and of a fix.
double match_sd_m(double score, const DriftCorrectionOptions& options);
double match_sd_m(const PoseFix& fix, const DriftCorrectionOptions& options);

/// The share of a fix's information that its neighbours along the path do not share.
std::vector<pose_graph::Constraint> constraints_of(std::span<const PoseFix> fixes,
                                                   std::span<const double> travelled_m,
                                                   const DriftCorrectionOptions& options);
std::vector<pose_graph::Constraint> constraints_of(std::span<const LoopClosure> loops,
                                                   std::span<const double> travelled_m,
                                                   const DriftCorrectionOptions& options);

/// A solved node; `on_map`: including the error that all matches share.
UncertainPose uncertain_pose(double time_s, const pose_graph::State& state, Eigen::Matrix3d covariance,
                             bool on_map, const DriftCorrectionOptions& options);

}  // namespace place
