#include "vo/gait/walker.hpp"

#include "vo/base/clock.hpp"
#include "vo/base/frame_range.hpp"
#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vo {
namespace {

/// How much a stretch of a signal resembles itself `period` frames later and its opposite half of that later,
/// -1 to 1.
double swings_at(std::span<const double> x, std::size_t period) {
  const auto correlation = [&](std::size_t lag) {
    double product = 0, early = 0, late = 0;
    for (std::size_t i = 0; i + lag < x.size(); ++i) {
      product += x[i] * x[i + lag];
      early += x[i] * x[i];
      late += x[i + lag] * x[i + lag];
    }
    return early > 0 && late > 0 ? product / std::sqrt(early * late) : 0;
  };
  if (period < 2 || 2 * period > x.size()) return 0;
  return (correlation(period) - (correlation(period / 2) + correlation((period + 1) / 2)) / 2) / 2;
}

/// How much a signal swings with every other bounce in a window.
double swing_with(const Signal& signal, const Periodicity& bounce, double rate_hz) {
  const std::size_t begin = bounce.frame - std::min(bounce.frame, bounce.reach);
  const std::size_t end = std::min(signal.values.size(), bounce.frame + bounce.reach + 1);
  const auto part = std::span(signal.values).subspan(begin, end - begin);
  const auto stride = static_cast<std::size_t>(std::lround(4 * bounce.step_s * rate_hz));
  double best = 0;
  for (std::size_t period = stride - std::min<std::size_t>(stride, 1); period <= stride + 1; ++period)
    best = std::max(best, swings_at(part, period));
  return best;
}

/// Ranges of steps that follow each other without a pause.
std::vector<FrameRange> bouts(std::span<const Step> steps, double pause_s) {
  std::vector<FrameRange> all;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i == 0 || steps[i].time_s - steps[i - 1].time_s > pause_s) all.push_back({i, i});
    all.back().end = i + 1;
  }
  return all;
}

}  // namespace

std::vector<bool> camera_travels(const GaitSignal& signal) {
  constexpr double kReach_s = 2.5;
  const std::vector<double>& growth = signal.growth_per_s;
  std::vector<double> sum(growth.size() + 1, 0);
  for (std::size_t i = 0; i < growth.size(); ++i) sum[i + 1] = sum[i] + growth[i];
  std::vector<bool> nearer;
  for (std::size_t i = 0; i < growth.size(); ++i) {
    const FrameRange near = frames_around(signal.time_s, {i, i + 1}, kReach_s);
    const double mean = (sum[near.end] - sum[near.begin]) / static_cast<double>(near.size());
    nearer.push_back(std::abs(mean) >= kLeastGrowth_per_s);
  }
  return nearer;
}

std::vector<Flow> steady_flow(const GaitSignal& signal) {
  constexpr double kReach_s = 2.5;
  const std::vector<Flow>& flow = signal.flow_per_s;
  std::vector<Flow> sum(flow.size() + 1);
  for (std::size_t i = 0; i < flow.size(); ++i)
    sum[i + 1] = {sum[i].right_rad + flow[i].right_rad, sum[i].down_rad + flow[i].down_rad};
  std::vector<Flow> steady;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    const FrameRange near = frames_around(signal.time_s, {i, i + 1}, kReach_s);
    const auto count = static_cast<double>(near.size());
    steady.push_back({(sum[near.end].right_rad - sum[near.begin].right_rad) / count,
                      (sum[near.end].down_rad - sum[near.begin].down_rad) / count});
  }
  return steady;
}

std::vector<bool> rides_past(const GaitSignal& signal, std::span<const Flow> steady) {
  if (!steady.empty() && steady.size() != signal.time_s.size())
    throw std::invalid_argument("rides_past: one flow for each frame expected");
  std::vector<bool> rides(signal.time_s.size(), false);
  const auto flows = [&](std::size_t i) {
    return std::hypot(steady[i].right_rad, steady[i].down_rad) >= kLeastFlow_rad_s;
  };
  const auto one_way = [&](std::size_t i, std::size_t k) {
    return steady[i].right_rad * steady[k].right_rad + steady[i].down_rad * steady[k].down_rad > 0;
  };
  for (std::size_t begin = 0, end = 0; begin < steady.size(); begin = std::max(end, begin + 1)) {
    Flow angle;
    for (end = begin; end < steady.size() && flows(end) && one_way(begin, end); ++end) {
      // Of a gap nothing is known but its last frame.
      const double frame_s =
          end > 0 ? std::min(signal.time_s[end] - signal.time_s[end - 1], kShortestGap_s) : 0;
      angle.right_rad += steady[end].right_rad * frame_s;
      angle.down_rad += steady[end].down_rad * frame_s;
    }
    if (std::hypot(angle.right_rad, angle.down_rad) < 2 * std::numbers::pi) continue;
    for (std::size_t i = begin; i < end; ++i) rides[i] = true;
  }
  return rides;
}

std::vector<bool> bounces_like_walker(const GaitSignal& signal, std::span<const Periodicity> bounce) {
  constexpr double kEven = 0.8, kEvenAndSwings = 1.2, kReach_s = 10;
  struct Window {
    double time_s, even, swings;
  };
  std::vector<Window> windows;
  for (const Periodicity& window : bounce) {
    if (!window.gait) continue;
    windows.push_back({signal.time_s[window.frame], window.strength,
                       std::max(swing_with(signal.orientation, window, signal.rate_hz),
                                swing_with(signal.shift, window, signal.rate_hz))});
  }
  std::vector<bool> walker;
  std::size_t begin = 0, end = 0, known_begin = 0, known_end = 0;
  bool known = false;
  for (const double time_s : signal.time_s) {
    while (begin < windows.size() && windows[begin].time_s < time_s - kReach_s) ++begin;
    while (end < windows.size() && windows[end].time_s <= time_s + kReach_s) ++end;
    if (begin != known_begin || end != known_end) {
      std::vector<double> even, swings;
      for (std::size_t i = begin; i < end; ++i) {
        even.push_back(windows[i].even);
        swings.push_back(windows[i].swings);
      }
      known = !even.empty();
      if (known) {
        const double evenness = median(std::move(even));
        known = evenness >= kEven || evenness + median(std::move(swings)) >= kEvenAndSwings;
      }
      known_begin = begin;
      known_end = end;
    }
    walker.push_back(known);
  }
  return walker;
}

StepDetection walkers_steps(StepDetection detection, const std::vector<bool>& walked, double pause_s) {
  if (detection.steps.empty()) return detection;
  if (detection.steps.back().frame >= walked.size())
    throw std::invalid_argument("walkers_steps: one flag per frame expected");
  const std::size_t first = detection.steps.front().frame, last = detection.steps.back().frame;
  std::erase_if(detection.steps, [&](const Step& step) { return !walked[step.frame]; });

  std::vector<Step> kept;
  for (const FrameRange& bout : bouts(detection.steps, pause_s)) {
    const std::span<const Step> steps = std::span(detection.steps).subspan(bout.begin, bout.size());
    const double length_s = steps.back().time_s - steps.front().time_s;
    const double cadence_hz = static_cast<double>(steps.size() - 1) / length_s;
    constexpr std::size_t kFew = 4;  // too few for a cadence
    if (steps.size() > kFew && (cadence_hz < kSlowestSteps_hz || cadence_hz > kFastestSteps_hz)) continue;
    kept.insert(kept.end(), steps.begin(), steps.end());
  }
  detection.steps = std::move(kept);
  detection.bridged = static_cast<std::size_t>(std::ranges::count(detection.steps, true, &Step::bridged));
  if (detection.steps.empty()) detection.gait_share = 0;
  if (detection.steps.empty() || detection.steps.front().frame != first) detection.partial.first = 1;
  if (detection.steps.empty() || detection.steps.back().frame != last) detection.partial.after = 0;
  return detection;
}

}  // namespace vo
