#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vo {

/// Settings of `stride_periodicity`.
struct PeriodicityOptions {
  double window_s = 5;         ///< seconds compared with themselves: five strides of a usual walk
  double hop_s = 0.2;          ///< seconds from one window to the next
  double min_step_hz = 1;      ///< slowest step looked for: a stroll has 1.2 or more
  double max_step_hz = 4;      ///< fastest: joggers have 3, sprinters little more than 4
  double min_strength = 0.55;  ///< of windows of gait; at -1 every window is gait
  double min_gait_s = 1;       ///< shortest time that gait keeps that strength, seconds
  double min_amplitude = 0;    ///< of gait, in the signal's unit: anything smaller is noise, however even
};

/// How much like gait a stretch of a signal is.
struct Periodicity {
  std::size_t frame = 0;  ///< middle of the window
  std::size_t reach = 0;  ///< frames of the window on either side of it
  double strength = 0;    ///< -1 to 1; 1 where each stride equals the last, and its halves are opposites
  double step_s = 0;      ///< half a stride; 0 if nothing could be compared
  double amplitude = 0;  ///< in the signal's unit, of a sinusoid with the window's power, wild values cut off
  bool gait = false;     ///< strong and large enough, and for long enough
};

/// Finds the stride in a low-passed orientation signal, window by window.
///
/// Not in PVO, which finds that blank walls cause false steps because the signal "isn't as periodically"
/// (Fig. 6) and goes no further. A walker leans to one side with one step and to the other with the next, so
/// the signal resembles itself one stride later and its opposite one step later: strength = (r(stride) -
/// r(stride / 2)) / 2, where r(lag) is the correlation of the window with itself, and the stride is the lag
/// with the largest strength, or the shortest lag within a tenth of it, as three strides are as alike as one.
/// Noise repeats in neither way; breathing, sway and drift are slower and have no opposite half.
///
/// Values beyond twice the window's upper quartile of absolute values are clipped to that.
///
/// With the defaults, white noise through the low-pass of 4 Hz at 25 frames/s is taken for gait some 0.2
/// times an hour, noise that wanders (a random walk with a memory of 0.8 s) some 4 times.
///
/// `signal`: about 0, one per frame; `rate_hz`: frames per second. Windows at the ends are moved inside:
/// a signal shorter than a window is one window, searched for strides up to half its length. Empty for an
/// empty signal. Throws `std::invalid_argument` for a rate or an option that is not above 0, or min_step_hz
/// >= max_step_hz. O(n * window * lags / hop).
std::vector<Periodicity> stride_periodicity(std::span<const double> signal, double rate_hz,
                                            const PeriodicityOptions& options = {});

/// The amplitude of an average step: the median of the windows of gait, each weighted by its power, so that a
/// few chance hits in a long pause do not outvote a short walk. None if there is no gait. O(n log n).
std::optional<double> gait_amplitude(std::span<const Periodicity> windows);

/// At each frame, the amplitude of an average step near it: the median over the windows of gait that cover
/// the frame; 0 where none does. Windows as from `stride_periodicity`. O(frames * windows that cover a
/// frame).
std::vector<double> local_gait_amplitude(std::span<const Periodicity> windows, std::size_t frames);

/// The window whose middle is nearest to a frame. Throws `std::invalid_argument` if there is none. O(1).
const Periodicity& nearest_window(std::span<const Periodicity> windows, std::size_t frame);

/// The amplitude of a sinusoid with the power that the signal has within `reach` frames of a frame.
double sinusoid_amplitude(std::span<const double> signal, std::size_t frame, std::size_t reach);

}  // namespace vo
