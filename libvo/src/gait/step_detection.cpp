#include "vo/gait/step_detection.hpp"

#include "vo/base/median.hpp"
#include "vo/gait/lowpass.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace vo {
namespace {

void check(std::span<const double> signal_deg, std::span<const double> time_s,
           const std::vector<bool>& reliable, const StepDetectionOptions& options) {
  if (time_s.size() != signal_deg.size() || reliable.size() != signal_deg.size())
    throw std::invalid_argument("detect_steps: one time and one flag per frame expected");
  if (options.delta_min_deg && !(*options.delta_min_deg >= 0))
    throw std::invalid_argument("detect_steps: delta_min_deg >= 0 expected");
  if (!(options.delta_min_ratio >= 0 && options.delta_dyn_ratio >= 0 && options.first_step_ratio >= 0 &&
        options.stride_ratio >= 0))
    throw std::invalid_argument("detect_steps: ratios >= 0 expected");
  if (options.pairs == 0 || !(options.pause_s > 0) || !(options.max_bridged_s >= 0))
    throw std::invalid_argument("detect_steps: pairs and pause_s above 0, max_bridged_s >= 0 expected");
}

/// Extrema that obey the sign rule, where a plateau is one extremum at its first frame.
std::vector<Step> signed_extrema(std::span<const double> signal_deg, std::span<const double> time_s) {
  std::vector<Step> extrema;
  double rise = 0;  // of the last change of value
  for (std::size_t i = 1, first = 0; i < signal_deg.size(); ++i) {
    const double change = signal_deg[i] - signal_deg[i - 1];
    if (change == 0) continue;
    const double value = signal_deg[first];
    if (rise > 0 && change < 0 && value > 0)
      extrema.push_back({first, time_s[first], Leg::kLeft, value, false});
    if (rise < 0 && change > 0 && value < 0)
      extrema.push_back({first, time_s[first], Leg::kRight, value, false});
    rise = change;
    first = i;
  }
  return extrema;
}

/// ratio * median(differences of the last pairs), over steps not parted by a pause; without a pair, what one
/// of average steps would give, less for a first step.
double dynamic_threshold_deg(const std::vector<Step>& steps, double now_s, double average_deg,
                             const StepDetectionOptions& options) {
  std::vector<double> differences;
  double after_s = now_s;
  for (std::size_t i = steps.size(); i > 0 && differences.size() < options.pairs; --i) {
    if (after_s - steps[i - 1].time_s > options.pause_s) break;
    if (i < steps.size()) differences.push_back(std::abs(steps[i].value_deg - steps[i - 1].value_deg));
    after_s = steps[i - 1].time_s;
  }
  if (differences.empty()) differences = {2 * average_deg * options.first_step_ratio};
  return options.delta_dyn_ratio * median(std::move(differences));
}

/// Adds a step, unless it is the last one seen again: on its side within one and a half steps, or within half
/// a step of it. Then the larger of the two stays.
void add_step(std::vector<Step>& steps, const Step& step, double step_s) {
  while (!steps.empty()) {
    const Step& last = steps.back();
    if (step.time_s - last.time_s >= (step.leg == last.leg ? 1.5 : 0.5) * step_s) break;
    if (std::abs(step.value_deg) <= std::abs(last.value_deg)) return;
    steps.pop_back();
  }
  steps.push_back(step);
}

/// Fills gaps between two steps by cadence. Returns how many were put in.
std::size_t bridge(std::vector<Step>& steps, std::span<const double> signal_deg,
                   std::span<const double> time_s, const std::vector<bool>& reliable,
                   const std::vector<Periodicity>& windows, double delta_min_deg,
                   const StepDetectionOptions& options) {
  std::vector<Step> filled;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i > 0) {
      const Step &a = steps[i - 1], &b = steps[i];
      const double gap_s = b.time_s - a.time_s;
      const double step_s =
          (nearest_window(windows, a.frame).step_s + nearest_window(windows, b.frame).step_s) / 2;
      // Steps from a to b: odd if they are of different legs.
      const double odd = a.leg == b.leg ? 0 : 1;
      const double count = step_s > 0 ? 2 * std::round((gap_s / step_s - odd) / 2) + odd : 1;
      std::size_t standing = 0;
      for (std::size_t f = a.frame + 1; f < b.frame; ++f)
        standing += reliable[f] && std::abs(signal_deg[f]) < delta_min_deg;
      if (count > 1 && gap_s <= options.max_bridged_s && 2 * standing < b.frame - a.frame) {
        for (double k = 1; k < count; ++k) {
          const auto frame = static_cast<std::size_t>(
              std::lround(std::lerp(static_cast<double>(a.frame), static_cast<double>(b.frame), k / count)));
          const Leg leg = filled.back().leg == Leg::kLeft ? Leg::kRight : Leg::kLeft;
          filled.push_back({frame, time_s[frame], leg, signal_deg[frame], true});
        }
      }
    }
    filled.push_back(steps[i]);
  }
  const std::size_t bridged = filled.size() - steps.size();
  steps = std::move(filled);
  return bridged;
}

}  // namespace

double steps_made(const StepDetection& detection) {
  if (detection.steps.empty()) return 0;
  return static_cast<double>(detection.steps.size() - 1) + detection.partial.first + detection.partial.after;
}

StepDetection detect_steps(std::span<const double> signal_deg, std::span<const double> time_s,
                           const std::vector<bool>& reliable, const StepDetectionOptions& options) {
  check(signal_deg, time_s, reliable, options);
  StepDetection result;
  result.delta_min_deg = options.delta_min_deg;
  result.delta_dyn_deg.assign(signal_deg.size(), 0);
  if (signal_deg.size() < 3) return result;

  const double rate_hz = frame_rate_hz(time_s);
  const std::vector<Periodicity> windows = stride_periodicity(signal_deg, rate_hz, options.periodicity);
  if (!result.delta_min_deg) {
    const auto average = gait_amplitude_deg(windows);
    if (!average) return result;
    result.delta_min_deg = options.delta_min_ratio * *average;
  }
  const std::vector<double> average_deg = local_gait_amplitude_deg(windows, signal_deg.size());

  result.gait_share =
      static_cast<double>(std::ranges::count_if(average_deg, [](double deg) { return deg > 0; })) /
      static_cast<double>(average_deg.size());

  auto drawn = result.delta_dyn_deg.begin();
  double delta_dyn_deg = 0;
  for (const Step& extremum : signed_extrema(signal_deg, time_s)) {
    const double value_deg = std::abs(extremum.value_deg);
    const double average = average_deg[extremum.frame];
    if (value_deg < *result.delta_min_deg || !reliable[extremum.frame] || average == 0) continue;
    const double step_s = nearest_window(windows, extremum.frame).step_s;
    const auto step_frames = static_cast<std::size_t>(std::lround(step_s * rate_hz));
    if (sinusoid_amplitude_deg(signal_deg, extremum.frame, step_frames) < options.stride_ratio * average)
      continue;
    const auto here = result.delta_dyn_deg.begin() + static_cast<std::ptrdiff_t>(extremum.frame);
    std::fill(drawn, here, delta_dyn_deg);
    drawn = here;
    delta_dyn_deg = dynamic_threshold_deg(result.steps, extremum.time_s, average, options);
    if (value_deg > delta_dyn_deg) add_step(result.steps, extremum, step_s);
  }
  std::fill(drawn, result.delta_dyn_deg.end(), delta_dyn_deg);
  result.bridged =
      bridge(result.steps, signal_deg, time_s, reliable, windows, *result.delta_min_deg, options);
  return result;
}

}  // namespace vo
