#pragma once

#include "odometry_evaluation_files.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include <place/evaluation/odometry_evaluation.hpp>

namespace retrace {

/// What is known of a walk that `measure_odometry` compares its odometry with.
struct WalkTruthOptions {
  std::string path;                          ///< truth.csv, or a path on a map
  std::optional<double> map_scale_m_per_px;  ///< of a path on a map
  std::string map_image;                     ///< to draw the trajectory over, or empty
  std::optional<std::size_t> steps;          ///< counted by hand; none: those of the truth
};

/// Measures the odometry in a folder that `retrace odometry` wrote, and writes odometry_metrics.json and the
/// report there. Throws `vo::Error` if it is not in metres, or shares less than the first distance of the
/// evaluation with the truth.
OdometryMeasured measure_odometry(const std::filesystem::path& folder, const WalkTruthOptions& known,
                                  const place::OdometryEvaluationOptions& evaluation);

}  // namespace retrace
