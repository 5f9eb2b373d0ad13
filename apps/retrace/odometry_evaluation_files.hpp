#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/evaluation/odometry_evaluation.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {

/// The truth of a walk: poses with times, or else its path drawn on a map, in metres.
struct WalkTruth {
  std::optional<std::size_t> steps;
  vo::PosesAlongRoute walk;
  std::vector<place::MapPoint> map_path;
};

/// Reads truth.csv, or a path on a map (x_px,y_px, y downwards, north up) for which the metres per pixel are
/// given. `counted_steps` overrides the steps of the file. Throws `vo::Error` naming the file if it is
/// neither, if it is a path on a map and no scale is given, or if it is not and one is.
WalkTruth read_walk_truth(const std::string& path, const std::optional<double>& map_scale_m_per_px,
                          const std::optional<std::size_t>& counted_steps);

/// What was measured on one walk, or on several taken together.
struct OdometryMeasured {
  std::size_t walks = 1;
  std::size_t steps = 0;                  ///< found, on all of them
  std::vector<place::StepCount> counted;  ///< of the walks whose true steps are known
  place::OdometryEvaluation evaluation;   ///< of all
};

/// All walks taken together (PVO 5.4).
OdometryMeasured pooled(const std::vector<OdometryMeasured>& walks);

/// odometry_metrics.json (PVO 5.2, 5.4).
nlohmann::ordered_json odometry_metrics_json(const OdometryMeasured& measured,
                                             const place::OdometryEvaluationOptions& options);

/// Throws `vo::Error` unless the trajectory in the folder is in metres, which the truth is compared in.
void check_metres(const std::filesystem::path& folder);

/// The errors at each distance, on standard output.
void print_odometry_metrics(const OdometryMeasured& measured);

}  // namespace retrace
