#include "vo/gait/playback.hpp"

#include "vo/base/median.hpp"
#include "vo/gait/even_motion.hpp"
#include "vo/gait/footfall.hpp"
#include "vo/gait/walker.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace vo {
namespace {

/// A bounce on another clock.
struct Bounce {
  double even = 0;   ///< how even it is where it resembles gait (`Periodicity::strength`), in the median
  double share = 0;  ///< of the recording in which it resembles gait while the camera travels
  double hz = 0;     ///< on the recording's own clock
};

/// The bounce of a walk that is played `speed` times as fast; none if it has too few frames per second for
/// that.
Bounce at_speed(const EvenMotion& motion, double speed, GaitSignalOptions signal_options,
                const StepReadingOptions& options) {
  constexpr double kFewest_hz = 5;  // frames a second: two and a half for each step of a brisk walk
  constexpr double kCutoff = 0.4;   // of the frame rate: under half of it, as filters must be
  const double rate_hz = motion.rate_hz * speed;
  if (rate_hz < kFewest_hz) return {};
  signal_options.lowpass.cutoff_hz = std::min(signal_options.lowpass.cutoff_hz, kCutoff * rate_hz);
  std::vector<double> time_s;
  for (const double at_s : motion.time_s) time_s.push_back(at_s / speed);
  const GaitSignal signal = gait_signal(motion.motion, time_s, signal_options);
  PeriodicityOptions periodicity = options.footfalls.periodicity;
  periodicity.min_amplitude =
      std::max(periodicity.min_amplitude, least_gait(signal.bounce.unit, signal.rate_hz));
  const std::vector<Periodicity> windows = bounce_windows(signal.bounce.values, signal.time_s, periodicity);
  const std::vector<bool> nearer = camera_travels(signal);
  std::vector<double> even, step_s;
  for (const Periodicity& window : windows) {
    if (!window.gait || !nearer[window.frame]) continue;
    even.push_back(window.strength);
    step_s.push_back(2 * window.step_s);
  }
  if (even.empty()) return {};
  const double share = static_cast<double>(even.size()) / static_cast<double>(windows.size());
  return {.even = median(std::move(even)), .share = share, .hz = 1 / median(std::move(step_s)) / speed};
}

}  // namespace

std::optional<double> impossible_cadence_hz(std::span<const FrameMotion> motion,
                                            std::span<const double> time_s, const GaitSignalOptions& signal,
                                            const StepReadingOptions& steps) {
  // Walks on their own clock have 0.83 to 0.98, anything else at most 0.74 (see `bounces_like_walker`).
  constexpr double kEven = 0.8;
  constexpr double kMost = 0.7;  // of the recording
  // Three bounces are as even as one, so a time lapse may look like a slightly less even walk; as in
  // `stride_periodicity`, the shortest that comes near counts.
  constexpr double kAsEven = 0.1;
  if (motion.size() != time_s.size())
    throw std::invalid_argument("impossible_cadence_hz: one time for each motion expected");
  if (time_s.size() < 3) return std::nullopt;
  const EvenMotion even = even_motion(motion, time_s);
  const Bounce own = at_speed(even, 1, signal, steps);
  Bounce best{.even = kEven};
  for (const double speed : {2.0, 4.0, 8.0, 1.0 / 2, 1.0 / 3, 1.0 / 4}) {
    if (own.even >= kEven && speed > 1) continue;
    const Bounce bounce = at_speed(even, speed, signal, steps);
    const bool impossible = bounce.hz < kSlowestCadence_hz || bounce.hz > kFastestCadence_hz;
    const double least = std::max(best.even, own.even - kAsEven);
    if (impossible && bounce.share >= kMost && bounce.even >= least) best = bounce;
  }
  return best.share > 0 ? std::optional(best.hz) : std::nullopt;
}

std::string impossible_cadence_text(double cadence_hz) {
  return fmt::format(
      "shows about {:.2g} steps a second throughout, where people make {} to {}, as in {}; speeds and steps "
      "are right with --frame-rate-hz, the rate that it was recorded at",
      cadence_hz, kSlowestSteps_hz, kFastestSteps_hz,
      cadence_hz < kSlowestCadence_hz ? "slow motion" : "a time lapse");
}

}  // namespace vo
