#include "vo/gait/step_way.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vo {
namespace {

/// The median of one field of those nearest to a place in a list, so many to either side.
template <typename Item, typename Field>
double nearest_median(const std::vector<Item>& items, std::ptrdiff_t at, Field field) {
  constexpr std::ptrdiff_t kNearest = 3;
  const auto size = static_cast<std::ptrdiff_t>(items.size());
  std::vector<double> values;
  for (auto i = std::max<std::ptrdiff_t>(0, at - kNearest); i < std::min(size, at + kNearest); ++i)
    values.push_back(items[static_cast<std::size_t>(i)].*field);
  return median(std::move(values));
}

}  // namespace

StepWay::StepWay(std::span<const double> spread, std::span<const double> time_s,
                 std::span<const std::size_t> step_frames, const StepWayOptions& options)
    : spread_(spread), time_s_(time_s), options_(options) {
  std::vector<Interval> all;
  for (std::size_t i = 1; i < step_frames.size(); ++i) {
    const std::size_t from = step_frames[i - 1], to = step_frames[i];
    const auto part = spread.subspan(from + 1, to - from);
    all.push_back(
        {.end = to,
         .seconds = time_s[to] - time_s[from],
         .spread = std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(to - from)});
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double usual_s = nearest_median(all, static_cast<std::ptrdiff_t>(i), &Interval::seconds);
    if (all[i].seconds < options.missed_ratio * usual_s) steps_.push_back(all[i]);
  }
}

StepWay::Interval StepWay::usual(std::size_t frame) const {
  const auto at = std::ranges::lower_bound(steps_, frame, {}, &Interval::end) - steps_.begin();
  return {.end = frame,
          .seconds = nearest_median(steps_, at, &Interval::seconds),
          .spread = nearest_median(steps_, at, &Interval::spread)};
}

bool StepWay::walking(std::size_t frame) const {
  const double half_s = step_s(frame) / 2;
  std::size_t a = frame, b = frame;
  while (a > 0 && time_s_[frame] - time_s_[a] < half_s) --a;
  while (b + 1 < time_s_.size() && time_s_[b] - time_s_[frame] < half_s) ++b;
  return between(a, b, frame) >= options_.min_way;
}

bool StepWay::gap(std::size_t a, std::size_t b) const {
  return time_s_[b] - time_s_[a] > options_.missed_ratio * step_s(b);
}

double StepWay::between(std::size_t a, std::size_t b, std::size_t measure) const {
  const Interval step = usual(measure);
  double steps = 0;
  for (std::size_t i = a + 1; i <= b; ++i) {
    const double share = spread_[i] / step.spread;
    if (share >= options_.min_spread)
      steps += std::sqrt(std::min(share, 1.0)) * (time_s_[i] - time_s_[i - 1]) / step.seconds;
  }
  return steps;
}

StepDetection complete_steps(StepDetection detection, const StepWay& way, std::span<const double> signal,
                             std::span<const double> time_s) {
  if (!way.known() || detection.steps.empty()) return detection;
  const std::vector<Step> seen = std::move(detection.steps);
  std::vector<Step>& steps = detection.steps;
  steps.clear();
  // Steps between two frames, neither of which counts, evenly.
  const auto fill = [&](std::size_t from, std::size_t to, double count, double parts) {
    for (double k = 1; k <= count; ++k) {
      const auto frame = static_cast<std::size_t>(
          std::lround(std::lerp(static_cast<double>(from), static_cast<double>(to), k / parts)));
      if (frame > (steps.empty() ? 0 : steps.back().frame) && frame < time_s.size())
        steps.push_back({frame, time_s[frame], Leg::kLeft, signal[frame], true});
    }
  };

  const std::size_t first = seen.front().frame, last = seen.back().frame, end = time_s.size() - 1;
  const double before = way.between(0, first, first), after = way.between(last, end, last);
  const double whole = std::floor(before + after);  // the first one seen is one of them
  const double lost_before =
      before >= after ? std::max(0.0, whole - 1 - std::floor(after)) : std::floor(before);
  fill(0, first, lost_before, lost_before + 1);
  for (const Step& step : seen) {
    if (steps.empty() || steps.back().frame < first || !way.gap(steps.back().frame, step.frame)) {
      steps.push_back(step);
      continue;
    }
    const double count = std::round(way.between(steps.back().frame, step.frame, step.frame));
    if (count >= 1) {
      fill(steps.back().frame, step.frame, count - 1, count);
      steps.push_back(step);
    } else if (std::abs(step.value_deg) > std::abs(steps.back().value_deg)) {
      steps.back() = step;
    }
  }
  const double lost_after = whole - 1 - lost_before;
  if (lost_after >= 0)
    fill(last, end, lost_after, std::max(after, lost_after));
  else
    steps.erase(before < after ? steps.begin() : steps.end() - 1);
  detection.bridged = static_cast<std::size_t>(std::ranges::count(steps, true, &Step::bridged));
  return detection;
}

}  // namespace vo
