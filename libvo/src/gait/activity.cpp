#include "vo/gait/activity.hpp"

#include "vo/gait/lowpass.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vo {

std::vector<ActivitySecond> detect_activity(std::span<const double> signal_deg,
                                            std::span<const double> time_s, const std::vector<bool>& reliable,
                                            const ActivityOptions& options) {
  if (time_s.size() != signal_deg.size() || reliable.size() != signal_deg.size())
    throw std::invalid_argument("detect_activity: one time and one flag per frame expected");
  if (!(options.run_step_hz > 0 && options.moving_ratio >= 0 && options.min_reliable >= 0))
    throw std::invalid_argument("detect_activity: run_step_hz above 0 and ratios >= 0 expected");
  std::vector<ActivitySecond> seconds;
  if (time_s.empty()) return seconds;

  const std::size_t frames = time_s.size();
  const double rate_hz = frames < 3 ? 1 : frame_rate_hz(time_s);
  const auto windows = stride_periodicity(signal_deg, rate_hz, options.periodicity);
  const std::vector<double> average_deg = local_gait_amplitude_deg(windows, frames);
  const auto quarter = static_cast<std::size_t>(std::lround(rate_hz / 4));
  for (std::size_t begin = 0, end = 0; begin < frames; begin = end) {
    ActivitySecond second{.time_s = time_s.front() + static_cast<double>(seconds.size())};
    std::size_t known = 0, gait = 0;
    for (; end < frames && time_s[end] < second.time_s + 1; ++end) {
      known += reliable[end] ? 1 : 0;
      gait += average_deg[end] > 0 ? 1 : 0;
    }
    const std::size_t count = end - begin;
    const std::size_t middle = begin + count / 2;
    const Periodicity& window = nearest_window(windows, middle);
    if (count > 0) second.amplitude_deg = sinusoid_amplitude_deg(signal_deg, middle, count / 2 + quarter);
    if (frames >= 3 && count > 0 &&
        static_cast<double>(known) >= options.min_reliable * static_cast<double>(count)) {
      const bool moving =
          2 * gait > count && second.amplitude_deg >= options.moving_ratio * average_deg[middle];
      if (moving && window.step_s > 0) second.step_hz = 1 / window.step_s;
      second.activity = !moving                                 ? Activity::kStanding
                        : second.step_hz >= options.run_step_hz ? Activity::kRunning
                                                                : Activity::kWalking;
    }
    seconds.push_back(second);
  }
  return seconds;
}

}  // namespace vo
