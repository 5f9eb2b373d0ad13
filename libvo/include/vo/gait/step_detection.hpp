#pragma once

#include "vo/gait/periodicity.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

enum class Leg { kLeft, kRight };

struct Step {
  std::size_t frame = 0;  ///< for a step in a gap of the clock, the first frame after it
  double time_s = 0;      ///< of the frame; in a gap, when the step was made
  Leg leg = Leg::kLeft;
  double value = 0;      ///< of the signal at the frame, in its unit
  bool bridged = false;  ///< not seen, but the cadence of the steps around it leaves room for it
};

/// Settings of `detect_steps`.
struct StepDetectionOptions {
  std::optional<double> delta_min;  ///< static threshold, in the signal's unit; none: learned from the walk
  double delta_min_ratio = 0.25;  ///< learned delta_min, as a share of an average step's value [PVO 5.3 (3)]
  double delta_dyn_ratio = 0.25;  ///< dynamic threshold, of the median difference of a pair [PVO 5.3 (3)]
  std::size_t pairs = 5;  ///< of successive left and right steps, for the median difference [PVO 5.3 (3)]
  double first_step_ratio = 0.75;  ///< of an average step; used in delta_dyn until pairs have been seen
  double stride_ratio = 0.35;      ///< least amplitude of a step's stride, as a share of the gait around it
  double pause_s = 1.5;            ///< longest step; after a longer gap, delta_dyn starts again
  double max_bridged_s = 5;        ///< longest gap between two steps to be filled by cadence; 0 fills none
  PeriodicityOptions periodicity;  ///< what counts as gait; min_strength = -1 lets everything pass
};

/// The shares of the steps during which a recording begins and ends.
struct PartialSteps {
  double first = 1;  ///< share of the first step made in the recording
  double after = 0;  ///< share made of one more step after the last
};

/// The steps of a walk and how they were found; values and thresholds in the unit of the signal.
struct StepDetection {
  std::vector<Step> steps;          ///< in order of time, bridged ones among them
  std::size_t bridged = 0;          ///< number of bridged steps
  PartialSteps partial;             ///< where the distance walked shows it (`complete_steps`)
  std::optional<double> delta_min;  ///< as given or learned; none if nothing in the walk resembles gait
  double gait_share = 0;            ///< share of frames about which the signal resembles gait
  std::vector<double> delta_dyn;    ///< at each frame; together with delta_min as in PVO's Fig. 3
};

/// The number of steps made in the recording, not always whole: the first step and one after the last count
/// by their shares.
double steps_made(const StepDetection& detection);

/// The extrema of a signal that obey PVO's sign rule (4.4): peaks above 0 for the left leg, and valleys below
/// 0 for the right; a plateau is one extremum at its first frame. One time per frame, else
/// `std::invalid_argument`. O(n).
std::vector<Step> signed_extrema(std::span<const double> signal, std::span<const double> time_s);

/// Finds the steps in the orientation signal (PVO 4.4, Fig. 2).
///
/// A peak above 0 is a step with the left leg, a valley below 0 one with the right; other extrema are not
/// steps. A step's value is at least delta_min and above delta_dyn = ratio * median of the absolute
/// differences of the last `pairs` pairs of successive steps. Of two steps in a row on one side, the larger
/// is kept.
///
/// What PVO leaves open or does differently:
/// - PVO sets delta_min by hand for each person. By default it is a quarter of the amplitude of the stretches
///   that resemble gait (`gait_amplitude`); without any, there are no steps.
/// - A step lies in a stretch that resembles gait (`stride_periodicity`), so that neither noise above the
///   thresholds nor a blank wall (Fig. 6) causes steps. Its stride is not far smaller than those of the gait
///   around it, as it would be in a pause next to it.
/// - The dynamic threshold exists before the first pair too, where PVO's has yet to grow (Fig. 3).
/// - Extrema on one side are one step seen twice only within one and a half steps of the local cadence;
///   further apart, a step between them was lost. Extrema on different sides are one step within half a step;
///   no cadence is faster than max_step_hz.
/// - After a gap longer than `pause_s`, earlier steps do not predict the next one's size: the walker has
///   paused, or ran before and strolls after.
/// - Steps lost in a short gap are filled in and marked, unless the walker is seen to pause in it. Two
///   strides of similar cadence around it give their number: odd between two steps of one side, even between
///   left and right.
///
/// A camera that stabilises its picture leaves no gait in the orientation, so delta_min is none. The median x
/// shift `without_drift` may be given instead; it does not show which leg is which, and steps are counted
/// less reliably.
///
/// `signal`: one value per frame, low-passed, about 0, unreliable frames bridged before the filter; `time_s`:
/// one per frame, increasing; `reliable`: one per frame, false where too few matches were found. No step is
/// found at an unreliable frame. Throws `std::invalid_argument` for other sizes or options out of range.
/// Fewer than three frames have no steps. O(n) plus the cost of `stride_periodicity`.
StepDetection detect_steps(std::span<const double> signal, std::span<const double> time_s,
                           const std::vector<bool>& reliable, const StepDetectionOptions& options = {});

}  // namespace vo
