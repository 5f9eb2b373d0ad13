#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

enum class StepLengthModel {
  kFixed,    ///< all steps have one length [PVO 5.3 (4)]
  kCadence,  ///< in proportion to cadence
};

/// Settings of `step_lengths_m`.
struct StepLengthOptions {
  StepLengthModel model = StepLengthModel::kCadence;
  double length_m = 0.7;  ///< of an average step, metres: measured, or `calibrated_step_length_m`
  std::optional<double>
      reference_cadence_hz;            ///< steps per second when it was measured; none: this walk's own mean
  double min_cadence_hz = 98.0 / 60;   ///< below, steps do not get shorter [Murakami and Otaka 2017]
  double max_cadence_hz = 140.0 / 60;  ///< above is running, where cadence says little about length
  double pause_s = 1.5;                ///< a longer gap between two steps says nothing about cadence
};

/// The step length of a walk of known distance and number of steps, which need not be whole (`steps_made`).
/// Throws `std::invalid_argument` unless both are above 0.
double calibrated_step_length_m(double distance_m, double steps);

/// Steps per second around step i, over the two strides around it, as left and right intervals differ; steps
/// beyond a pause are left out. None for a step on its own. O(1).
std::optional<double> local_cadence_hz(std::span<const Step> steps, std::size_t i, double pause_s);

/// The length of each step, metres.
///
/// PVO measures a person's step once and uses it for all. But walking faster is in equal parts quicker and
/// longer steps: step length over cadence, the walk ratio, is constant for a person over all usual speeds
/// (Sekiya and Nagasaki, "Reproducibility of the walking patterns of normal young adults: test-retest
/// reliability of the walk ratio", Gait & Posture, 1998), down to 98 steps a minute (Murakami and Otaka,
/// "Estimated lower speed boundary at which the walk ratio constancy is broken", J. Phys. Ther. Sci., 2017).
/// So, length = length_m * cadence / reference cadence, with cadences kept within bounds.
///
/// kCadence is the default: without a reference cadence, the walk is as long as with fixed steps, but a
/// stroll that becomes a march is not 15 % too long in its first half and too short in its second. The walk
/// ratio differs between people by more than step length does, so it cannot replace a measured length.
///
/// Cadence is that of the two strides around a step, without steps beyond a pause; a step on its own has the
/// average length. Throws `std::invalid_argument` for an option that is not above 0, or min_cadence_hz >
/// max_cadence_hz. O(n).
std::vector<double> step_lengths_m(std::span<const Step> steps, const StepLengthOptions& options = {});

}  // namespace vo
