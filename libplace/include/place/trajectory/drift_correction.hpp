#pragma once

#include "place/match/match.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vo/base/trajectory.hpp>

namespace place {

/// A place recognised: at a node of the walk, the walker was about here.
struct PoseFix {
  std::size_t node = 0;  ///< index in the walk's odometry
  vo::Pose2 pose;        ///< of the one who walked there before
  double score = 0;      ///< of the match, in deviations of the enhanced cost
  /// That the match is right, and its standard deviation along the path if it is, metres. With a probability
  /// the score does not count.
  std::optional<double> probability, sd_m;
};

/// The same place seen twice in one walk.
struct LoopClosure {
  std::size_t node = 0;
  std::size_t earlier = 0;  ///< the node that saw it before; < node
  double score = 0;         ///< as of a match
};

/// Settings of `correct_drift`: how far odometry and matches are to be believed. Standard deviations; where a
/// comment says "per sqrt(m)", that of a random walk after one metre.
struct DriftCorrectionOptions {
  double step_scale_sd = 0.15;         ///< of the walk's step length, as a share of that given
  double step_scale_walk = 0.005;      ///< how fast it changes, per sqrt(m)
  double turn_scale_sd = 0.1;          ///< of the field of view: the share by which turns are off
  double turn_scale_walk = 1e-4;       ///< per sqrt(m); a camera does not change
  double bias_sd_rad_per_m = 0.01;     ///< of a steady drift to one side, radians per metre
  double bias_walk_rad_per_m = 0.002;  ///< how fast that changes, radians per metre per sqrt(m)
  double step_noise_m = 0.08;          ///< along the way walked, metres per sqrt(m)
  double side_noise_m = 0.05;          ///< to the side of it, metres per sqrt(m)
  double turn_noise_rad = 0.03;        ///< radians per sqrt(m)
  double node_noise_m = 0.05;          ///< of one node's position in the odometry, metres
  double node_noise_rad = 0.01;        ///< of one node's heading (the trunk swings), radians

  double match_least_m = 0.15;       ///< of the surest match along the path, metres
  double match_doubtful_m = 3.5;     ///< the same at probability or score 0, beside that; fades with ...
  double match_score = 1;            ///< ... this score, in its unit
  double aside_m = 0.25;             ///< across the path: two walkers do not tread the same line, metres
  double match_heading_rad = 0.15;   ///< of a match's heading; far larger errors are let go
  double match_correlation_m = 1.5;  ///< matches closer than this err alike, metres of the way
  double steady_along_m = 0.2;       ///< what all matches err by along the path, metres; ...
  double steady_aside_m = 0.2;       ///< ... and across: one walker keeps to a side of the other's line
  double outlier_chi2 = 5.99;  ///< squared error, in variances, at which a match is let go: 95 % of 2 dof

  /// False, with a reason that names field, value and constraint, if a field is out of its range.
  bool is_valid(std::string* reason) const;
};

/// A pose and how well it is known.
struct UncertainPose {
  double time_s = 0;
  vo::Pose2 pose;
  /// of x, y and heading, row by row; m^2, m rad, rad^2
  std::array<double, 9> covariance{};
};

/// What became of a correction.
enum class DriftStatus {
  kCorrected,
  kNoAgreement,  ///< fewer than three matches agree with the odometry between them: no place to begin at
};

/// A walk without its drift.
struct CorrectedWalk {
  DriftStatus status = DriftStatus::kNoAgreement;
  std::vector<UncertainPose> poses;  ///< one for each node; none unless `kCorrected`
  std::vector<double> fix_weight;    ///< of each fix, how far it was believed, 0 to 1
  std::vector<double> loop_weight;   ///< of each loop closure
  std::vector<double> step_scale;    ///< at each node, true over given step length
  std::vector<double> turn_scale;    ///< at each node, true over measured turn
};

/// Corrects a walk's odometry by the places recognised on the way: a pose graph over its nodes, one for each
/// keyframe.
///
/// A node has its pose and, slowly varying, the scale of steps, that of turns (a wrong field of view makes
/// every turn too large by the same share) and a drift to one side per metre. Odometry ties neighbours; a fix
/// ties a node to the pose of the matched place, loosely across the path, as walkers keep to different lanes,
/// and to its heading. A fix counts by its probability p: its variance along the path is match_least_m^2 +
/// sd_m^2 + (1 - p) match_doubtful_m^2; without one by its score, its standard deviation is match_least_m +
/// match_doubtful_m * exp(-score / match_score). Neighbouring fixes repeat each other's errors, so that there
/// is a limit to what a metre of the way tells.
///
/// Wrong matches let go: graduated non-convexity with Geman and McClure's cost (Yang, Antonante, Tzoumas and
/// Carlone, "Graduated Non-Convexity for Robust Spatial Perception", 2020). It begins where matches agree:
/// each match says how the odometry lies on the map around it, and the places of those whose neighbours say
/// the same are joined, so that headings may have gone astray by any amount. Solved by Ceres.
///
/// Stretches without fixes ride on corrected odometry, and their covariance grows. To the covariance of the
/// solution is added that of what no match on one route can show: steady_along_m and steady_aside_m.
///
/// `odometry`: the nodes' poses in the walk's own frame, with times; `fixes` and `loops` by increasing
/// node, at most one each. Without fixes, poses are relative to the first node, which is put where the
/// odometry has it. Throws `std::invalid_argument` for options that are not valid, nodes that are not there,
/// or unordered fixes. Memory is linear in nodes and fixes; 20,000 nodes take seconds (`drift_bench`).
CorrectedWalk correct_drift(const vo::Trajectory& odometry, std::span<const PoseFix> fixes,
                            std::span<const LoopClosure> loops = {},
                            const DriftCorrectionOptions& options = {});

/// The corrected poses of all of a walk's odometry, of which the nodes are a part: between two nodes the
/// odometry is carried from the one's correction over to the other's, evenly in time; beyond the first and
/// last it keeps theirs. `nodes`: their indices in `odometry`, increasing, one for each corrected pose.
/// Throws `std::invalid_argument` for another number of nodes, or none. O(n).
vo::Trajectory corrected_between(const vo::Trajectory& odometry, std::span<const std::size_t> nodes,
                                 const CorrectedWalk& walk);

}  // namespace place
