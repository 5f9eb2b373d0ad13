#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

enum class StepLengthModel {
  kFixed,    ///< every step alike [PVO 5.3 (4)]
  kCadence,  ///< in proportion to cadence
};

/// Settings of `step_lengths_m`.
struct StepLengthOptions {
  StepLengthModel model = StepLengthModel::kCadence;
  double length_m = 0.7;  ///< of an average step, metres: measured, or `calibrated_step_length_m`
  std::optional<double>
      reference_cadence_hz;            ///< steps per second it was measured at; none: this walk's own mean
  double min_cadence_hz = 98.0 / 60;   ///< below, steps do not get shorter [Murakami and Otaka 2017]
  double max_cadence_hz = 140.0 / 60;  ///< above, one runs (see activity), and cadence tells little of length
  double pause_s = 1.5;                ///< a longer gap between two steps says nothing of cadence
};

/// The step length of a walk of known distance with so many steps, which need not be whole (`steps_made`).
/// Throws `std::invalid_argument` unless both are above 0.
double calibrated_step_length_m(double distance_m, double steps);

/// Steps per second about step i: over the two strides about it, as far as no pause parts them from it, as
/// left and right intervals differ; none if it stands alone. O(1).
std::optional<double> local_cadence_hz(std::span<const Step> steps, std::size_t i, double pause_s);

/// The length of each step, metres.
///
/// PVO measures a person's step once and takes it for all. Walking faster is half quicker and half longer
/// steps, though: step length over cadence, the walk ratio, is one number for a person over all usual speeds
/// (Sekiya and Nagasaki, "Reproducibility of the walking patterns of normal young adults: test-retest
/// reliability of the walk ratio", Gait & Posture, 1998), down to 98 steps a minute (Murakami and Otaka,
/// "Estimated lower speed boundary at which the walk ratio constancy is broken", J. Phys. Ther. Sci., 2017).
/// So, length = length_m * cadence / reference cadence, with cadences kept within bounds.
///
/// kCadence is the default: without a reference cadence, the walk is as long as with steps of fixed length,
/// but a stroll that becomes a march is not 15 % too long in its first half and too short in its second. The
/// walk ratio itself differs between persons by more than their step lengths do, so that it gives no length
/// to one who has measured nothing.
///
/// Cadence is that of the two strides about a step, as far as no pause parts them from it; a step all by
/// itself has the average length. Throws `std::invalid_argument` for an option that is not above 0, or
/// min_cadence_hz > max_cadence_hz. O(n).
std::vector<double> step_lengths_m(std::span<const Step> steps, const StepLengthOptions& options = {});

}  // namespace vo
