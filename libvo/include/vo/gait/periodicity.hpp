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
  double min_strength = 0.55;  ///< of windows of gait; -1 lets all be gait
  double min_gait_s = 1;       ///< seconds for which strength lasts in gait
  double min_amplitude = 0;    ///< of gait, in the signal's unit: what is less is noise, however even
};

/// How much like gait a stretch of a signal is.
struct Periodicity {
  std::size_t frame = 0;  ///< middle of the window
  std::size_t reach = 0;  ///< frames it has to either side
  double strength = 0;    ///< -1 to 1; 1 where each stride is as the last, and its halves are opposites
  double step_s = 0;      ///< half a stride; 0 if nothing could be compared
  double amplitude = 0;  ///< in the signal's unit, of a sinusoid with the window's power, wild values cut off
  bool gait = false;     ///< strong and large enough, and for long enough
};

/// Finds the stride in a low-passed orientation signal, window by window.
///
/// Not in PVO, which finds that blank walls breed false steps because the signal "isn't as periodically"
/// (Fig. 6) and leaves it at that. Walking leans to one side with one step and to the other with the next, so
/// that the signal is like itself a stride later and unlike itself a step later: strength = (r(stride) -
/// r(stride / 2)) / 2, where r(lag) is the correlation of the window with itself, and the stride is the lag
/// of the largest; the shortest of those that come within a tenth of it, as three strides are as alike as
/// one. Noise has neither; breathing, sway and drift are slower and have no opposite half.
///
/// Values beyond twice the upper quartile of their size in the window are cut off there.
///
/// With the defaults, white noise through the low-pass of 4 Hz at 25 frames/s is taken for gait some 0.2
/// times an hour, noise that wanders (a random walk with a memory of 0.8 s) some 4 times.
///
/// `signal`: about 0, one per frame; `rate_hz`: frames per second. Windows at the ends are moved inside;
/// a signal shorter than a window is one window, in which strides up to half its length are looked for. Empty
/// for an empty signal. Throws `std::invalid_argument` for a rate or an option that is not above 0, or
/// min_step_hz >= max_step_hz. O(n * window * lags / hop).
std::vector<Periodicity> stride_periodicity(std::span<const double> signal, double rate_hz,
                                            const PeriodicityOptions& options = {});

/// The amplitude of an average step: the median of the windows of gait, each weighted by its power, so that a
/// few chance hits in a long stand do not outvote a short walk. None if there is no gait. O(n log n).
std::optional<double> gait_amplitude(std::span<const Periodicity> windows);

/// At each frame, the amplitude of an average step about it: the median of the windows of gait that cover the
/// frame; 0 where none does. Windows as from `stride_periodicity`. O(frames * windows that cover a frame).
std::vector<double> local_gait_amplitude(std::span<const Periodicity> windows, std::size_t frames);

/// The window whose middle is nearest to a frame. Throws `std::invalid_argument` if there is none. O(1).
const Periodicity& nearest_window(std::span<const Periodicity> windows, std::size_t frame);

/// The amplitude of a sinusoid with the power that the signal has within `reach` frames of a frame.
double sinusoid_amplitude(std::span<const double> signal, std::size_t frame, std::size_t reach);

}  // namespace vo
