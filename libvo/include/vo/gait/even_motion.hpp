#pragma once

#include "vo/gait/gait_signal.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// The motion of a walk at evenly spaced times, which the gait filters and stride lengths in frames assume.
struct EvenMotion {
  double rate_hz = 0;               ///< times a second, the walk's usual frame rate
  std::vector<double> time_s;       ///< from the first frame's to the last's
  std::vector<FrameMotion> motion;  ///< at each time, as the change since the one before
};

/// Resamples the motion of a walk to even times (not in PVO, whose cameras have one frame rate).
///
/// A frame's motion is the mean over its tracking window, so as a rate it belongs to the middle of that
/// window, in seconds. Rates are interpolated linearly between neighbouring frames; at an even frame rate
/// nothing changes. Where the frame rate halves, points move twice as far from frame to frame; taken as
/// rates, that no longer looks like a swing.
///
/// Nothing is known where neighbouring frames were not tracked, and over a jump of the clock (`clock_gaps`);
/// give the times of a walk `without_long_gaps`. `motion`, `time_s`: one of each per frame. Throws
/// `std::invalid_argument` for other sizes or fewer than two frames. O(n).
EvenMotion even_motion(std::span<const FrameMotion> motion, std::span<const double> time_s);

/// Values at even times, interpolated linearly at other times; constant before the first and after the last.
/// `even_s` increases. Throws `std::invalid_argument` if there are no values, or not one for each time.
/// O((values + times) log values).
std::vector<double> read_at(std::span<const double> values, std::span<const double> even_s,
                            std::span<const double> at_s);

/// The signal at the frames of a walk, interpolated from the one at even times. `time_s`: of the frames, on
/// the same clock; `motion`: of the frames, which decides whether each is reliable. O(n log n).
GaitSignal signal_at_frames(const GaitSignal& even, std::span<const FrameMotion> motion,
                            std::span<const double> time_s);

}  // namespace vo
