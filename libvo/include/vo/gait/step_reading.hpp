#pragma once

#include "vo/gait/footfall.hpp"
#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_detection.hpp"
#include "vo/gait/step_fusion.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace vo {

/// What steps are read from.
enum class StepSignal {
  kOrientation,  ///< the camera rolls with each stride [PVO]
  kBounce,       ///< the picture moves up and down with each step
  kShift,  ///< it swings from side to side: where nothing else is like gait, as with cameras that hold their
           ///< horizon and height steady; legs are then a guess
  kPublished,  ///< the orientation, by PVO's rules alone
};

/// Settings of `read_steps`.
struct StepReadingOptions {
  /// None: the bounce, unless another shows gait in more of the walk; the orientation if its static threshold
  /// is given.
  std::optional<StepSignal> signal;
  StepDetectionOptions detection;
  FootfallOptions footfalls;
  StepFusionOptions fusion;
};

/// One way to read the steps of a walk. All are given the same and may be put in place of each other.
struct StepReader {
  StepSignal signal;           ///< that it reads
  std::string_view name;       ///< "orientation", "bounce", "x shift", "orientation by PVO"
  Signal GaitSignal::*values;  ///< that signal
  StepDetection (*read)(const GaitSignal& signal, const StepReadingOptions& options);
  bool on_request = false;  ///< only if asked for by name
};

/// The readers there are, in the order of `StepSignal`.
///
/// - The orientation's is PVO's (`detect_steps`), with steps from the shift where points are few
///   (`fill_steps`), unless `options.signal` asks for the orientation by name.
/// - The bounce's is `detect_footfalls`, its legs those of the orientation.
/// - The shift's is `detect_steps`, completed by the way (`complete_steps`); where most of its steps were not
///   seen but filled in, there are none.
///
/// - That of `kPublished` is `detect_steps_as_published`, with `options.detection.delta_min` if it is given.
///
/// Of all but the last, only the steps of a walker count: the camera gets on (`gets_on`), bounces as one does
/// (`bounces_as_walker`), swings by no less than noise can (`least_gait`), and the cadence is one of people
/// (`walkers_steps`).
std::span<const StepReader> step_readers();

/// The one that reads a signal.
const StepReader& reader_of(StepSignal signal);

/// The steps of a walk and what shows them.
struct StepReading {
  StepSignal signal = StepSignal::kOrientation;  ///< which the steps were read from
  StepDetection detection;                       ///< in the signal's unit
};

/// Reads the steps of a walk (PVO 4.4) by the reader of the signal asked for, or the one that shows them
/// best. A static threshold that is given is one of the orientation. `signal`: at even times. O(n) and what
/// `stride_periodicity` takes.
StepReading read_steps(const GaitSignal& signal, const StepReadingOptions& options = {});

}  // namespace vo
