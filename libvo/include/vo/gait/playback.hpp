#pragma once

#include "vo/gait/gait_signal.hpp"
#include "vo/gait/step_reading.hpp"

#include <optional>
#include <span>
#include <string>

namespace vo {

/// Steps per second outside which nobody steps for the length of a recording. People make `kSlowestSteps_hz`
/// to `kFastestSteps_hz`; the rest is a margin for reading errors.
inline constexpr double kSlowestCadence_hz = 0.8, kFastestCadence_hz = 4;

/// The steps per second that a walk shows throughout, if people cannot step so slowly or so fast (not in
/// PVO): slow motion or a time lapse, whose clock is not the walker's, so that speeds and steps read from it
/// are wrong. None if the bounce is a walk's on the recording's own clock, or on no clock, as with a camera
/// that steadies its picture or a time lapse with fewer than four frames per step.
///
/// The bounce is read as if the recording were played 2, 4 and 8 times as fast, and 2, 3 and 4 times as
/// slowly, down to 5 frames a second: it is a walk's if it is even (0.8, as in `bounces_like_walker`) and
/// lasts for 0.7 of the recording while the camera travels. The result is precise to a frame per step.
///
/// `motion`, `time_s`: of each frame, on a clock without long gaps (`without_long_gaps`). Throws
/// `std::invalid_argument` for another number of times. O(n) plus seven times the cost of `bounce_windows`.
std::optional<double> impossible_cadence_hz(std::span<const FrameMotion> motion,
                                            std::span<const double> time_s,
                                            const GaitSignalOptions& signal = {},
                                            const StepReadingOptions& steps = {});

/// A sentence about such a recording: "shows about 0.48 steps a second ...".
std::string impossible_cadence_text(double cadence_hz);

}  // namespace vo
