#pragma once

#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_reading.hpp"

#include <optional>
#include <span>
#include <string>

namespace vo {

/// Steps a second beyond which nobody steps for the length of a recording. People make `kSlowestSteps_hz` to
/// `kFastestSteps_hz`; the rest is for what is read wrongly.
inline constexpr double kSlowestCadence_hz = 0.8, kFastestCadence_hz = 4;

/// The steps a second that a walk shows throughout, where nobody makes so few or so many (not in PVO): slow
/// motion or a time lapse, whose clock is not the walker's, so that no speed and no step that is read by it
/// is right. None where the bounce is that of a walk by the recording's own clock, and where it is by no
/// other: so of a camera that steadies its picture, and of a time lapse with fewer than four frames for each
/// step.
///
/// The bounce is read as if the recording were played 2, 4 and 8 times as fast, and 2, 3 and 4 times as
/// slowly, down to 5 frames a second: it is a walk's if it is even (0.8, as of `bounces_as_walker`) and lasts
/// for 0.7 of the recording, while the camera gets nearer to what it sees. The result is good to a frame of a
/// step's.
///
/// `motion`, `time_s`: of each frame, on a clock without long gaps (`without_long_gaps`). Throws
/// `std::invalid_argument` for another number of times. O(n) and seven times what `bounce_windows` takes.
std::optional<double> impossible_cadence_hz(std::span<const FrameMotion> motion,
                                            std::span<const double> time_s,
                                            const GaitSignalOptions& signal = {},
                                            const StepReadingOptions& steps = {});

/// What that says of a recording, in words: "shows about 0.48 steps a second ...".
std::string impossible_cadence_text(double cadence_hz);

}  // namespace vo
