#pragma once

#include "vo/gait/gait_signal.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// The motion of a walk at even times, as the filters of the gait signal and the lengths of strides in frames
/// take them to be.
struct EvenMotion {
  double rate_hz = 0;               ///< times a second, the walk's usual frame rate
  std::vector<double> time_s;       ///< from the first frame's to the last's
  std::vector<FrameMotion> motion;  ///< at each, as the change since the time before
};

/// Resamples the motion of a walk to even times (not in PVO, whose cameras have one frame rate).
///
/// A frame's motion is the mean over the frames that its tracking window reaches back; as a rate it belongs
/// to the middle of them, in seconds. Rates are read off straight lines between those of neighbouring frames,
/// and kept where they were at an even frame rate: then, nothing changes. Where the frame rate halves, points
/// move twice as far from frame to frame, and what looked like a swing of that rhythm is gone.
///
/// Nothing is known where neighbouring frames were not tracked, and over a jump of the clock (`clock_gaps`);
/// give the times of a walk `without_long_gaps`. `motion`, `time_s`: one of each per frame. Throws
/// `std::invalid_argument` for other sizes or fewer than two frames. O(n).
EvenMotion even_motion(std::span<const FrameMotion> motion, std::span<const double> time_s);

/// Values given at even times, read off at others by straight lines; before the first and after the last, as
/// there. `even_s` increases. Throws `std::invalid_argument` for another number of values than times, or
/// none. O((values + times) log values).
std::vector<double> read_at(std::span<const double> values, std::span<const double> even_s,
                            std::span<const double> at_s);

/// The signal at the frames of a walk, as read off the one at even times. `time_s`: of the frames, on the
/// same clock; `motion`: theirs, by which a frame is reliable. O(n log n).
GaitSignal signal_at_frames(const GaitSignal& even, std::span<const FrameMotion> motion,
                            std::span<const double> time_s);

}  // namespace vo
