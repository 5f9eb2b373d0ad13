#pragma once

#include "vo/gait/step_detection.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace vo {

/// Settings of `detect_steps_as_published`.
struct PublishedStepOptions {
  std::optional<double> delta_min;  ///< static threshold, in the signal's unit; none: `delta_min_ratio`
  double delta_min_ratio = 0.25;    ///< of the value of an average step [PVO 5.3 (3)]
  double delta_dyn_ratio = 0.25;    ///< of the median difference of the last steps [PVO 5.3 (3)]
  std::size_t last_steps = 5;       ///< whose differences count, >= 2 [PVO 5.3 (3)]
};

/// Finds steps in the orientation signal by the rules of PVO 4.4 and 5.3 (3) alone.
///
/// - An extremum is a peak above 0, a step with the left leg, or a valley below 0, one with the right; other
///   peaks and valleys do not count.
/// - One with a value below delta_min is noise. Any other updates delta_dyn = ratio * median of the absolute
///   differences of the last five steps, each from the one before it: four differences, each of a left and a
///   right step, as steps alternate.
/// - It is a step if its value is greater than delta_dyn. Of two in a row with the same leg, the one with the
///   larger value stays, however long ago the other was.
///
/// The signal need not resemble gait, and no step is filled in, so a standing walker gives false steps if
/// delta_min is 0 (Fig. 3a), and so does large noise (Fig. 6). Our `detect_steps` avoids that.
///
/// Where PVO is silent: before there are two steps, delta_dyn is 0; a plateau is an extremum at its first
/// frame; of two equal steps with one leg, the first stays. PVO sets delta_min by hand for each person. If
/// not given, the average step is the amplitude of the stretches that resemble gait (`gait_amplitude`);
/// without any, delta_min is 0.
///
/// `signal`: one value per frame, low-passed; `time_s`: one per frame, increasing. `delta_dyn` of the result
/// is that at each frame, as Fig. 3 draws it. Throws `std::invalid_argument` for another number of times or
/// options out of range. O(n), plus the cost of `stride_periodicity` if delta_min is not given.
StepDetection detect_steps_as_published(std::span<const double> signal, std::span<const double> time_s,
                                        const PublishedStepOptions& options = {});

}  // namespace vo
