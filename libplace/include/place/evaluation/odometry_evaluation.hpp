#pragma once

#include "vo/base/trajectory.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace place {

/// The true pose of a walker, and the odometry's at the same moment.
struct PosePair {
  double distance_m = 0;  ///< truly travelled since the start
  vo::Pose2 truth;
  vo::Pose2 estimate;
};

/// Pairs poses at the same time, for a truth with times. `truth` and `distance_m`: one per moment; moments
/// without an estimate, or without progress since the one before, are left out. Throws
/// `std::invalid_argument` for another number of distances. O(n log n).
std::vector<PosePair> pair_by_time(const vo::Trajectory& truth, std::span<const double> distance_m,
                                   const vo::Trajectory& estimate);

/// A point of a path drawn on a map, metres.
struct MapPoint {
  double x_m = 0;
  double y_m = 0;
};

/// Pairs poses by their share of the whole path, for a truth without times: the estimate at 30 % of its
/// length is paired with the point at 30 % of the true path. So both begin and end together, as in the
/// recording, and an estimate that is too long shows as such, as it would by time. The true heading is that
/// of the leg. One pair for each pose with which the estimate moves forward. Throws `std::invalid_argument`
/// for a path without length; an estimate without length has no pairs. O(n).
std::vector<PosePair> pair_by_share(std::span<const MapPoint> path, const vo::Trajectory& estimate);

/// Settings of `evaluate_odometry`.
struct OdometryEvaluationOptions {
  std::size_t segments = 25;                         ///< measurements [PVO 5.2]
  double segment_m = 100;                            ///< their length [PVO 5.2: 50 indoors, 100 outdoors]
  std::vector<double> at_m{5, 10, 25, 50, 75, 100};  ///< where along them errors are measured [PVO 5.2]
  std::uint64_t seed = 1;                            ///< of the random starts
};

/// The errors at one distance from the start of a segment.
struct OdometryErrors {
  double at_m = 0;
  std::size_t count = 0;  ///< segments that reach this far; if 0, the rest are 0
  double euclidean_mean_m = 0, euclidean_sd_m = 0;
  /// Truth minus estimate, clockwise: positive where the estimate drifts to the left, as in PVO 5.4.
  double heading_mean_deg = 0, heading_sd_deg = 0;
  double heading_abs_mean_deg = 0;
  std::vector<double> euclidean_m, heading_deg;  ///< each measurement, `count` of them
};

struct OdometryEvaluation {
  double distance_m = 0;               ///< of the pairs
  double segment_m = 0;                ///< as asked for, or the longest of `at_m` that fits the walk
  std::vector<OdometryErrors> errors;  ///< one for each of `at_m`, in order
};

/// PVO's accuracy of a trajectory (section 5.2): random segments, at whose start the estimate is aligned with
/// the true pose, and errors at set distances from there.
///
/// Distances are those truly travelled, not the estimate's, so that too long a step is an error of position.
/// Starts are uniform over all places with a whole segment ahead. On a walk shorter than a segment, the
/// segment is cut to the longest of `at_m` that fits. Points beyond a segment have count 0, as do all points
/// if the walk is shorter than the first. Between pairs, poses are linear in distance. sd is the standard
/// deviation of the sample (n - 1), 0 for a single one.
///
/// `pairs`: by strictly increasing distance, as from the functions above. Throws `std::invalid_argument` if
/// they are not, for no or unordered `at_m`, or one or a segment_m not above 0. The same seed gives the same
/// segments. O(segments * log n).
OdometryEvaluation evaluate_odometry(std::span<const PosePair> pairs,
                                     const OdometryEvaluationOptions& options = {});

/// The measurements of several walks taken together (PVO 5.4: mean and standard deviation over all
/// measurements of all videos of a path). A walk too short for a distance has none there. The distance
/// is that of all walks together, the segment the longest one. Throws `std::invalid_argument` for no walks,
/// or walks measured at different distances. O(measurements).
OdometryEvaluation pooled(std::span<const OdometryEvaluation> walks);

/// Steps found in a walk and steps made.
struct StepCount {
  std::size_t estimated = 0;
  std::size_t truth = 0;
};

/// The errors of several walks' numbers of steps (PVO 5.4). sd is that of the sample, 0 for one walk.
struct StepErrors {
  double mean = 0, sd = 0;                    ///< found minus true, steps per walk: positive if too many
  double absolute_mean = 0, absolute_sd = 0;  ///< of its absolute value
  double pct = 0;  ///< the mean absolute error, in per cent of the mean true number
};

/// Throws `std::invalid_argument` for no walks, or walks without a true step among them all. O(walks).
StepErrors step_errors(std::span<const StepCount> walks);

}  // namespace place
