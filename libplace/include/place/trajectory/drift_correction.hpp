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

/// A recognised place: at a node of the walk, the walker was near this pose.
struct PoseFix {
  std::size_t node = 0;  ///< index in the walk's odometry
  vo::Pose2 pose;        ///< of the reference walker there
  double score = 0;      ///< of the match, in deviations of the enhanced cost
  /// The probability that the match is right, and its standard deviation along the path if so, metres. With a
  /// probability, the score is ignored.
  std::optional<double> probability, sd_m;
  std::optional<double> aside_sd_m;  ///< standard deviation across the path; none: `aside_m` of the options
};

/// The same place seen twice in one walk.
struct LoopClosure {
  std::size_t node = 0;
  std::size_t earlier = 0;  ///< the earlier node at that place; < node
  double score = 0;         ///< as for a match
};

/// Settings of `correct_drift`: how much to trust odometry and matches. Standard deviations; "per sqrt(m)"
/// means that of a random walk after one metre.
struct DriftCorrectionOptions {
  double step_scale_sd = 0.15;         ///< of the walk's step length, as a share of the given one
  double step_scale_walk = 0.005;      ///< how fast it changes, per sqrt(m)
  double turn_scale_sd = 0.1;          ///< of the field of view: the relative error of turns
  double turn_scale_walk = 1e-4;       ///< per sqrt(m); a camera does not change
  double bias_sd_rad_per_m = 0.01;     ///< of a steady drift to one side, radians per metre
  double bias_walk_rad_per_m = 0.002;  ///< how fast that changes, radians per metre per sqrt(m)
  double step_noise_m = 0.08;          ///< along the direction of travel, metres per sqrt(m)
  double side_noise_m = 0.05;          ///< across it, metres per sqrt(m)
  double turn_noise_rad = 0.03;        ///< radians per sqrt(m)
  double node_noise_m = 0.05;          ///< of one node's position in the odometry, metres
  double node_noise_rad = 0.01;        ///< of one node's heading (the trunk swings), radians

  double match_least_m = 0.15;       ///< of the surest match along the path, metres
  double match_doubtful_m = 3.5;     ///< added at probability or score 0; fades with ...
  double match_score = 1;            ///< ... this score, in its unit
  double aside_m = 0.25;             ///< across the path, metres: two walkers do not take the same line
  double match_heading_rad = 0.15;   ///< of a match's heading; far larger errors are rejected
  double match_correlation_m = 1.5;  ///< matches closer than this along the path share their error, metres
  double steady_along_m = 0.2;       ///< common error of all matches along the path, metres; ...
  double steady_aside_m = 0.2;       ///< ... and across: a walker keeps to one side of the other's line
  double outlier_chi2 = 5.99;  ///< squared error, in variances, at which a match is rejected: 95 % of 2 dof

  /// False, with a reason that names field, value and constraint, if a field is out of its range.
  bool is_valid(std::string* reason) const;
};

/// A pose and its uncertainty.
struct UncertainPose {
  double time_s = 0;
  vo::Pose2 pose;
  /// of x, y and heading, row by row; m^2, m rad, rad^2
  std::array<double, 9> covariance{};
};

/// The outcome of a correction.
enum class DriftStatus {
  kCorrected,
  kNoAgreement,  ///< fewer than three matches agree with the odometry between them: no starting point
};

/// A walk with its drift removed.
struct CorrectedWalk {
  DriftStatus status = DriftStatus::kNoAgreement;
  std::vector<UncertainPose> poses;  ///< one for each node; none unless `kCorrected`
  std::vector<double> fix_weight;    ///< how much each fix was trusted, 0 to 1
  std::vector<double> loop_weight;   ///< the same for each loop closure
  std::vector<double> step_scale;    ///< at each node, true over given step length
  std::vector<double> turn_scale;    ///< at each node, true over measured turn
};

/// Corrects a walk's odometry by the places recognised along it: a pose graph over its nodes, one for each
/// keyframe.
///
/// A node has its pose and, slowly varying, the scale of steps, that of turns (a wrong field of view makes
/// every turn too large by the same share) and a drift to one side per metre. Odometry ties neighbours; a fix
/// ties a node to the pose of the matched place, loosely across the path, as walkers keep to different lanes,
/// and to its heading. A fix is weighted by its probability p: its variance along the path is match_least_m^2
/// + sd_m^2 + (1 - p) match_doubtful_m^2. Without one it is weighted by its score: its standard deviation is
/// match_least_m + match_doubtful_m * exp(-score / match_score). Neighbouring fixes repeat each other's
/// errors, so the information per metre is limited.
///
/// Wrong matches are rejected by graduated non-convexity with Geman and McClure's cost (Yang, Antonante,
/// Tzoumas and Carlone, "Graduated Non-Convexity for Robust Spatial Perception", 2020). It starts where
/// matches agree: each match places the odometry around it on the map, and matches whose neighbours place it
/// alike are joined, so that headings may have drifted by any amount. Solved with Ceres.
///
/// Stretches without fixes follow the corrected odometry, and their covariance grows. The covariance of the
/// solution is increased by the errors that no match on one route can show: steady_along_m and
/// steady_aside_m.
///
/// Over a gap of the recording odometry says nothing: the next node may be anywhere, with a standard
/// deviation of 1000 m, which is also that of nodes after it without a fix.
///
/// `odometry`: the nodes' poses in the walk's own frame, with times; `fixes` and `loops` by increasing node,
/// at most one each; `gaps`: the nodes right after gaps, increasing (`gaps_at`). Without fixes, poses are
/// relative to the first node, which keeps its odometry pose. Throws `std::invalid_argument` for options that
/// are not valid, nodes that do not exist, or unordered fixes or gaps. Memory is linear in nodes and fixes;
/// 20,000 nodes take seconds (`drift_bench`).
CorrectedWalk correct_drift(const vo::Trajectory& odometry, std::span<const PoseFix> fixes,
                            std::span<const LoopClosure> loops = {},
                            const DriftCorrectionOptions& options = {},
                            std::span<const std::size_t> gaps = {});

/// The corrected poses of all of a walk's odometry, of which the nodes are a part: between two nodes the
/// correction is interpolated, evenly in time; beyond the first and last it keeps theirs. `nodes`: their
/// indices in `odometry`, increasing, one for each corrected pose. Throws `std::invalid_argument` for another
/// number of nodes, or none. O(n).
vo::Trajectory corrected_between(const vo::Trajectory& odometry, std::span<const std::size_t> nodes,
                                 const CorrectedWalk& walk);

}  // namespace place
