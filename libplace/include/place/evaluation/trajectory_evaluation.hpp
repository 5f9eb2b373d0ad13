#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <vo/base/trajectory.hpp>

namespace place {

/// How a trajectory is aligned before it is compared.
enum class TrajectoryAlignment {
  kNone,   ///< not at all: the coordinates are the truth's
  kRigid,  ///< rotated and translated as a whole (evo's -a)
  kScaled  ///< also scaled (evo's -a -s)
};

/// Settings of `evaluate_trajectory`.
struct TrajectoryEvaluationOptions {
  TrajectoryAlignment alignment = TrajectoryAlignment::kNone;
  double max_time_difference_s = 0.01;  ///< between paired poses [evo: --t_max_diff]
  std::size_t delta = 1;                ///< poses between the two that RPE compares [evo: --delta, in frames]
};

/// The statistics that evo prints for a series of errors.
struct ErrorStatistics {
  double rmse = 0, mean = 0, median = 0, sd = 0, min = 0, max = 0, sse = 0;
};

/// A trajectory's errors, metres; 0 with fewer than two poses in common, or fewer than delta + 1.
struct TrajectoryEvaluation {
  std::size_t poses = 0;   ///< compared
  double end_error_m = 0;  ///< of the last compared pose
  ErrorStatistics ape_m;   ///< absolute pose error: distance from the true position
  ErrorStatistics rpe_m;   ///< relative pose error: of the motion from one pose to the delta-th after it
};

/// Indices (estimate, truth) of poses at the same time: for each pose of the shorter trajectory the nearest
/// of the longer within the difference, as evo pairs them. O(n log n).
std::vector<std::pair<std::size_t, std::size_t>> pair_poses(const vo::Trajectory& estimate,
                                                            const vo::Trajectory& truth,
                                                            double max_time_difference_s);

/// Absolute and relative pose errors of positions, as `evo_ape tum` and `evo_rpe tum` define them (Sturm et
/// al., "A Benchmark for the Evaluation of RGB-D SLAM Systems", 2012): APE is |p_estimate - p_truth|; RPE is
/// the length of the translation of (Q_i^-1 Q_i+d)^-1 (P_i^-1 P_i+d), with poses Q true and P estimated, for
/// i = 0, d, 2 d, ... Alignment is Umeyama's ("Least-squares estimation of transformation parameters between
/// two point patterns", 1991), here in the plane; also used for RPE. sd is over n. Throws
/// `std::invalid_argument` for delta 0 or a negative time difference. O(n log n).
TrajectoryEvaluation evaluate_trajectory(const vo::Trajectory& estimate, const vo::Trajectory& truth,
                                         const TrajectoryEvaluationOptions& options = {});

}  // namespace place
