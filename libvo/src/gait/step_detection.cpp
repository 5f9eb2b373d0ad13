#include "vo/gait/step_detection.hpp"

#include "vo/base/clock.hpp"
#include "vo/base/median.hpp"
#include "vo/gait/lowpass.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace vo {
namespace {

void check(std::span<const double> signal, std::span<const double> time_s, const std::vector<bool>& reliable,
           const StepDetectionOptions& options) {
  if (time_s.size() != signal.size() || reliable.size() != signal.size())
    throw std::invalid_argument("detect_steps: one time and one flag per frame expected");
  if (options.delta_min && !(*options.delta_min >= 0))
    throw std::invalid_argument("detect_steps: delta_min >= 0 expected");
  if (!(options.delta_min_ratio >= 0 && options.delta_dyn_ratio >= 0 && options.first_step_ratio >= 0 &&
        options.stride_ratio >= 0))
    throw std::invalid_argument("detect_steps: ratios >= 0 expected");
  if (options.pairs == 0 || !(options.pause_s > 0) || !(options.max_bridged_s >= 0))
    throw std::invalid_argument("detect_steps: pairs and pause_s above 0, max_bridged_s >= 0 expected");
}

/// ratio * median(differences of the last pairs), over steps without a pause between them; without a pair,
/// that of a pair of average steps, less for a first step.
double dynamic_threshold(const std::vector<Step>& steps, double now_s, double average,
                         const StepDetectionOptions& options) {
  std::vector<double> differences;
  double after_s = now_s;
  for (std::size_t i = steps.size(); i > 0 && differences.size() < options.pairs; --i) {
    if (after_s - steps[i - 1].time_s > options.pause_s) break;
    if (i < steps.size()) differences.push_back(std::abs(steps[i].value - steps[i - 1].value));
    after_s = steps[i - 1].time_s;
  }
  if (differences.empty()) differences = {2 * average * options.first_step_ratio};
  return options.delta_dyn_ratio * median(std::move(differences));
}

/// Adds a step, unless it is the last one seen again: on the same side within one and a half steps, or on
/// either within half a step. Then the larger of the two stays.
void add_step(std::vector<Step>& steps, const Step& step, double step_s) {
  while (!steps.empty()) {
    const Step& last = steps.back();
    if (step.time_s - last.time_s >= (step.leg == last.leg ? 1.5 : 0.5) * step_s) break;
    if (std::abs(step.value) <= std::abs(last.value)) return;
    steps.pop_back();
  }
  steps.push_back(step);
}

/// Fills gaps between two steps by cadence. Returns the number of steps added.
std::size_t bridge(std::vector<Step>& steps, std::span<const double> signal, std::span<const double> time_s,
                   const std::vector<bool>& reliable, const std::vector<Periodicity>& windows,
                   double delta_min, const StepDetectionOptions& options) {
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
        standing += reliable[f] && std::abs(signal[f]) < delta_min;
      if (count > 1 && gap_s <= options.max_bridged_s && 2 * standing < b.frame - a.frame) {
        for (double k = 1; k < count; ++k) {
          const auto frame = static_cast<std::size_t>(
              std::lround(std::lerp(static_cast<double>(a.frame), static_cast<double>(b.frame), k / count)));
          const Leg leg = filled.back().leg == Leg::kLeft ? Leg::kRight : Leg::kLeft;
          filled.push_back({frame, time_s[frame], leg, signal[frame], true});
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

std::vector<Step> signed_extrema(std::span<const double> signal, std::span<const double> time_s) {
  if (time_s.size() != signal.size())
    throw std::invalid_argument("signed_extrema: one time per frame expected");
  std::vector<Step> extrema;
  double rise = 0;  // of the last change of value
  for (std::size_t i = 1, first = 0; i < signal.size(); ++i) {
    const double change = signal[i] - signal[i - 1];
    if (change == 0) continue;
    const double value = signal[first];
    if (rise > 0 && change < 0 && value > 0)
      extrema.push_back({first, time_s[first], Leg::kLeft, value, false});
    if (rise < 0 && change > 0 && value < 0)
      extrema.push_back({first, time_s[first], Leg::kRight, value, false});
    rise = change;
    first = i;
  }
  return extrema;
}

double steps_made(const StepDetection& detection) {
  if (detection.steps.empty()) return 0;
  return static_cast<double>(detection.steps.size() - 1) + detection.partial.first + detection.partial.after;
}

StepDetection detect_steps(std::span<const double> signal, std::span<const double> time_s,
                           const std::vector<bool>& reliable, const StepDetectionOptions& options) {
  check(signal, time_s, reliable, options);
  StepDetection result;
  result.delta_min = options.delta_min;
  result.delta_dyn.assign(signal.size(), 0);
  if (signal.size() < 3) return result;

  const double rate_hz = frame_rate_hz(time_s);
  const std::vector<Periodicity> windows = stride_periodicity(signal, rate_hz, options.periodicity);
  if (!result.delta_min) {
    const auto average = gait_amplitude(windows);
    if (!average) return result;
    result.delta_min = options.delta_min_ratio * *average;
  }
  const std::vector<double> around = local_gait_amplitude(windows, signal.size());

  result.gait_share =
      static_cast<double>(std::ranges::count_if(around, [](double amplitude) { return amplitude > 0; })) /
      static_cast<double>(around.size());

  auto drawn = result.delta_dyn.begin();
  double delta_dyn = 0;
  for (const Step& extremum : signed_extrema(signal, time_s)) {
    const double value = std::abs(extremum.value);
    const double average = around[extremum.frame];
    if (value < *result.delta_min || !reliable[extremum.frame] || average == 0) continue;
    const double step_s = nearest_window(windows, extremum.frame).step_s;
    const auto step_frames = static_cast<std::size_t>(std::lround(step_s * rate_hz));
    if (sinusoid_amplitude(signal, extremum.frame, step_frames) < options.stride_ratio * average) continue;
    const auto here = result.delta_dyn.begin() + static_cast<std::ptrdiff_t>(extremum.frame);
    std::fill(drawn, here, delta_dyn);
    drawn = here;
    delta_dyn = dynamic_threshold(result.steps, extremum.time_s, average, options);
    if (value > delta_dyn) add_step(result.steps, extremum, step_s);
  }
  std::fill(drawn, result.delta_dyn.end(), delta_dyn);
  result.bridged = bridge(result.steps, signal, time_s, reliable, windows, *result.delta_min, options);
  return result;
}

}  // namespace vo
