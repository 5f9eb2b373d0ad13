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
  kShift,  ///< it swings from side to side: used where nothing else resembles gait, as with cameras that hold
           ///< horizon and height steady; legs are then a guess
  kPublished,  ///< the orientation, by PVO's rules alone
};

/// Settings of `read_steps`.
struct StepReadingOptions {
  /// None: the bounce, unless another signal shows gait in more of the walk; the orientation if its static
  /// threshold is given.
  std::optional<StepSignal> signal;
  StepDetectionOptions detection;
  FootfallOptions footfalls;
  StepFusionOptions fusion;
};

/// One way to read the steps of a walk. All readers take the same inputs and are interchangeable.
struct StepReader {
  StepSignal signal;           ///< the signal it reads
  std::string_view name;       ///< "orientation", "bounce", "x shift", "orientation by PVO"
  Signal GaitSignal::*values;  ///< where its values are
  StepDetection (*read)(const GaitSignal& signal, const StepReadingOptions& options);
  bool on_request = false;  ///< only if asked for by name
};

/// All readers, in the order of `StepSignal`.
///
/// - Orientation: PVO's (`detect_steps`), with steps from the shift where points are few (`fill_steps`),
///   unless `options.signal` asks for the orientation by name.
/// - Bounce: `detect_footfalls`, with legs from the orientation.
/// - Shift: `detect_steps`, completed from the distance walked (`complete_steps`); no steps if most of them
///   were not seen but filled in.
/// - `kPublished`: `detect_steps_as_published`, with `options.detection.delta_min` if it is given.
///
/// In all but the last, only a walker's steps count: the camera travels (`camera_travels`), bounces like a
/// walker (`bounces_like_walker`), swings by more than noise does (`least_gait`), and the cadence is human
/// (`walkers_steps`).
std::span<const StepReader> step_readers();

/// The reader of a signal.
const StepReader& reader_of(StepSignal signal);

/// The steps of a walk and the signal they came from.
struct StepReading {
  StepSignal signal = StepSignal::kOrientation;  ///< that the steps were read from
  StepDetection detection;                       ///< in the signal's unit
};

/// Reads the steps of a walk (PVO 4.4) from the signal asked for, or from the one that shows them best. A
/// given static threshold is one of the orientation. `signal`: at even times. O(n) plus the cost of
/// `stride_periodicity`.
StepReading read_steps(const GaitSignal& signal, const StepReadingOptions& options = {});

}  // namespace vo
