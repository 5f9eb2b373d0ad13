#pragma once

#include "vo/gait/footfall.hpp"
#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_detection.hpp"
#include "vo/gait/step_fusion.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

/// What steps are read from.
enum class StepSignal {
  kOrientation,  ///< the camera rolls with each stride [PVO]
  kBounce,       ///< the picture moves up and down with each step
  kShift,  ///< it swings from side to side: where nothing else is like gait, as with cameras that hold their
           ///< horizon and height steady; legs are then a guess
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

/// The steps of a walk and what shows them.
struct StepReading {
  StepSignal signal = StepSignal::kOrientation;  ///< which the steps were read from
  StepSignal stride = StepSignal::kOrientation;  ///< which shows the stride: orientation or shift
  StepDetection detection;                       ///< in the signal's unit: degrees, or pixels of shift
};

/// Reads the steps of a walk (PVO 4.4) from the signal asked for, or the one that shows them best.
///
/// By the bounce, they are those of `detect_footfalls`; by the orientation, as in PVO, with those from the
/// shift where points are few (`fill_steps`), unless it was asked for; by the shift, completed by the way
/// (`complete_steps`). `matches`, `time_s`: one per frame of the signal. Throws as these do. O(n) and what
/// `stride_periodicity` takes.
StepReading read_steps(const GaitSignal& signal, std::span<const std::size_t> matches,
                       std::span<const double> time_s, const StepReadingOptions& options = {});

/// The low-passed values of one of the signals, one for each frame.
const std::vector<double>& values_of(StepSignal which, const GaitSignal& signal);

}  // namespace vo
