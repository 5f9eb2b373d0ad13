#pragma once

#include "vo/gait/periodicity.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

enum class Leg { kLeft, kRight };

struct Step {
  std::size_t frame = 0;  ///< of a step in a gap of the clock: the first after it
  double time_s = 0;      ///< of the frame; in a gap, when it was made
  Leg leg = Leg::kLeft;
  double value = 0;      ///< of the signal at the frame, in its unit
  bool bridged = false;  ///< not seen, but between steps whose cadence leaves room for it
};

/// Settings of `detect_steps`.
struct StepDetectionOptions {
  std::optional<double> delta_min;  ///< static threshold, in the signal's unit; none: learned from the walk
  double delta_min_ratio = 0.25;  ///< learned delta_min, as a share of an average step's value [PVO 5.3 (3)]
  double delta_dyn_ratio = 0.25;  ///< dynamic threshold, of the median difference of a pair [PVO 5.3 (3)]
  std::size_t pairs = 5;  ///< left and right steps in succession, of which the median is taken [PVO 5.3 (3)]
  double first_step_ratio = 0.75;  ///< of an average step; stands in delta_dyn for pairs not yet seen
  double stride_ratio = 0.35;      ///< least amplitude of the stride about a step, of the gait's around it
  double pause_s = 1.5;            ///< longest step; after a longer gap, delta_dyn begins anew
  double max_bridged_s = 5;        ///< longest gap between two steps to be filled by cadence; 0 fills none
  PeriodicityOptions periodicity;  ///< what is gait; min_strength = -1 lets everything pass
};

/// What a recording has of the steps that it begins and ends within.
struct PartialSteps {
  double first = 1;  ///< share of the first step that was made in it
  double after = 0;  ///< share made of one more, after the last
};

/// The steps of a walk and what they were found by; values and thresholds in the unit of the signal.
struct StepDetection {
  std::vector<Step> steps;          ///< in order of time, bridged ones among them
  std::size_t bridged = 0;          ///< how many of them are
  PartialSteps partial;             ///< where the way tells it (`complete_steps`)
  std::optional<double> delta_min;  ///< as given or learned; none if nothing in the walk is like gait
  double gait_share = 0;            ///< of the frames, those about which the signal is like gait
  std::vector<double> delta_dyn;    ///< at each frame; with delta_min what PVO's Fig. 3 shows
};

/// Steps that the way in the recording amounts to: all of them, of the first and of one after the last the
/// shares made in it.
double steps_made(const StepDetection& detection);

/// The extrema of a signal that obey PVO's sign rule (4.4): peaks above 0, of the left leg, and valleys below
/// 0, of the right; a plateau is one extremum, at its first frame. One time per frame, else
/// `std::invalid_argument`. O(n).
std::vector<Step> signed_extrema(std::span<const double> signal, std::span<const double> time_s);

/// Finds the steps in the orientation signal (PVO 4.4, Fig. 2).
///
/// A peak above 0 is a step with the left leg, a valley below 0 one with the right; other extrema are none. A
/// step's value is at least delta_min and above delta_dyn = ratio * median of the absolute differences of the
/// last `pairs` pairs of successive steps. Of two steps in a row on one side, the larger is kept.
///
/// What PVO leaves open, or does otherwise:
/// - delta_min is set by hand for each person there. Not given, it is a quarter of the amplitude of the
///   stretches that are like gait (`gait_amplitude`); where there are none, there are no steps.
/// - A step lies in a stretch that is like gait (`stride_periodicity`), so that neither noise above the
///   thresholds nor a blank wall (Fig. 6) breeds steps; and the stride about it is not far smaller than those
///   of the gait around it, as it would be in a stand beside it.
/// - There is a dynamic threshold before the first pair as well, where PVO's has yet to grow (Fig. 3).
/// - Extrema on one side are one step seen twice only within one and a half steps of the local cadence;
/// further
///   apart, the one between was lost. Those on different sides are, too, within half a step; no cadence is
///   faster than max_step_hz.
/// - After a gap longer than `pause_s`, steps before it say nothing of the next one's size: the walker has
///   stood, or ran before and strolls after.
/// - Steps lost in a short gap are filled in and marked, unless the walker is seen to stand in it: from two
///   strides of like cadence around it follows how many went into it, odd between two steps of one side, even
///   between left and right.
///
/// A camera that stabilises its picture leaves no gait in the orientation, so that delta_min is none. The
/// median x shift `without_drift` may be given instead then; which leg is which is not known from it, and
/// steps are counted less surely.
///
/// `signal`: one value per frame, low-passed, about 0, unreliable frames bridged before the filter;
/// `time_s`: one per frame, increasing; `reliable`: one per frame, false where too few matches were found. No
/// step is found at an unreliable frame. Throws `std::invalid_argument` for other sizes or options out of
/// range. Fewer than three frames have no steps. O(n) and what `stride_periodicity` takes.
StepDetection detect_steps(std::span<const double> signal, std::span<const double> time_s,
                           const std::vector<bool>& reliable, const StepDetectionOptions& options = {});

}  // namespace vo
