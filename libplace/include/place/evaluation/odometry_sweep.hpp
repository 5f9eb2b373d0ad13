#pragma once

#include "place/evaluation/odometry_evaluation.hpp"
#include "place/evaluation/sweep.hpp"
#include "place/evaluation/sweep_grid.hpp"
#include "place/settings.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vo/base/progress.hpp>
#include <vo/io/trajectory_io.hpp>

namespace place {

/// A walk whose odometry is measured, and the truth about it.
struct OdometrySweepWalk {
  std::string name;  ///< for messages
  WalkReader read;
  vo::WalkTruth truth;
};

/// What was measured on all walks together with one value of the setting.
struct OdometrySweepRow {
  std::string value;
  std::size_t steps = 0;                  ///< found
  std::optional<StepErrors> step_errors;  ///< of the walks whose true steps are known
  OdometryEvaluation evaluation;          ///< pooled (PVO 5.4)
};

/// How much better a row is than another at one distance (PVO Table 1).
struct OdometryImprovement {
  double euclidean_pct = 0;     ///< E-P: of the mean error, positive where it is smaller
  double euclidean_sd_pct = 0;  ///< E-STD: the same of its standard deviation
  double heading_deg = 0;       ///< H-D: of the size of the mean heading error, negative where it is smaller
  double heading_sd_deg = 0;    ///< H-STD: the same of its standard deviation
};

/// 0 in percent of an error of 0.
OdometryImprovement improvement(const OdometryErrors& errors, const OdometryErrors& base);

/// Odometry of all walks with every value of one setting of reading, motion or odometry, measured as PVO 5.2
/// and 5.4 have it: PVO Table 1, where the setting is the tracking window. The same segments for every value.
/// A walk is read once, or once for each value of a setting that shapes what is read.
///
/// Throws `vo::Error` naming a setting that cannot vary or has no effect, and a walk whose odometry is not in
/// metres or that is shorter than every distance; what the readers throw.
std::vector<OdometrySweepRow> sweep_odometry(std::span<const OdometrySweepWalk> walks,
                                             const Settings& settings, const SweepAxis& axis,
                                             const OdometryEvaluationOptions& options = {});

}  // namespace place
