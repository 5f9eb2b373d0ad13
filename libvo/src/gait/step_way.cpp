#include "vo/gait/step_way.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

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

/// Steps between two frames, neither of which counts: as many, a `parts`th of the time apart.
std::vector<Step> evenly(std::size_t from, std::size_t to, double count, double parts,
                         std::span<const double> signal, std::span<const double> time_s) {
  std::vector<Step> steps;
  for (double k = 1; k <= count; ++k) {
    const auto frame = static_cast<std::size_t>(
        std::lround(std::lerp(static_cast<double>(from), static_cast<double>(to), k / parts)));
    if (frame > (steps.empty() ? from : steps.back().frame) && frame < time_s.size())
      steps.push_back({frame, time_s[frame], Leg::kLeft, signal[frame], true});
  }
  return steps;
}

/// Bridged steps with the other leg than the step beside them.
void alternate_bridged(std::vector<Step>& steps) {
  const auto other = [](Leg leg) { return leg == Leg::kLeft ? Leg::kRight : Leg::kLeft; };
  const auto seen = std::ranges::find(steps, false, &Step::bridged);
  for (auto step = seen; step != steps.begin(); --step) std::prev(step)->leg = other(step->leg);
  for (auto step = seen; step != steps.end(); ++step)
    if (step->bridged) step->leg = other(std::prev(step)->leg);
}

}  // namespace

StepWay::StepWay(std::span<const double> growth, std::span<const double> time_s,
                 std::span<const std::size_t> step_frames, const StepWayOptions& options)
    : growth_(growth), time_s_(time_s), options_(options) {
  std::vector<Interval> all;
  for (std::size_t i = 1; i < step_frames.size(); ++i) {
    const std::size_t from = step_frames[i - 1], to = step_frames[i];
    const auto part = growth.subspan(from + 1, to - from);
    all.push_back(
        {.end = to,
         .seconds = time_s[to] - time_s[from],
         .growth = std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(to - from)});
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
          .growth = nearest_median(steps_, at, &Interval::growth)};
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
  if (!(step.growth > 0)) return (time_s_[b] - time_s_[a]) / step.seconds;
  double steps = 0;
  for (std::size_t i = a + 1; i <= b; ++i) {
    const double share = growth_[i] / step.growth;
    if (share >= options_.min_growth)
      steps += std::sqrt(std::min(share, 1.0)) * (time_s_[i] - time_s_[i - 1]) / step.seconds;
  }
  return steps;
}

StepDetection complete_steps(StepDetection detection, const StepWay& way, std::span<const double> signal,
                             std::span<const double> time_s) {
  if (!way.known() || detection.steps.empty()) return detection;
  std::vector<Step> steps;
  const auto add = [&](const std::vector<Step>& more) {
    steps.insert(steps.end(), more.begin(), more.end());
  };
  for (const Step& step : detection.steps) {
    if (steps.empty() || !way.gap(steps.back().frame, step.frame)) {
      steps.push_back(step);
      continue;
    }
    const std::size_t from = steps.back().frame;
    double count = std::round(way.between(from, step.frame, step.frame));
    constexpr double kStand = 3;  // steps: to stop and start again takes no less time
    if (time_s[step.frame] - time_s[from] < kStand * way.step_s(step.frame)) count = std::max(count, 1.0);
    if (count >= 1) {
      add(evenly(from, step.frame, count - 1, count, signal, time_s));
      steps.push_back(step);
    } else if (std::abs(step.value_deg) > std::abs(steps.back().value_deg)) {
      steps.back() = step;
    }
  }

  const std::size_t first = steps.front().frame, last = steps.back().frame, end = time_s.size() - 1;
  const double before = way.between(0, first, first), after = way.between(last, end, last);
  constexpr double kDone = 0.9;  // of a step: the way is known no better than to a tenth
  const double more = std::floor(before + after + 1 - kDone) - 1;  // the first one seen is one of them
  if (more < 0) {
    steps.erase(before < after ? steps.begin() : steps.end() - 1);
  } else {
    const double at_start = std::clamp(std::ceil(before - 1 + kDone) - 1, 0.0, more);
    const std::vector<Step> lost = evenly(0, first, at_start, at_start + 1, signal, time_s);
    add(evenly(last, end, more - at_start, std::max(after, more - at_start), signal, time_s));
    steps.insert(steps.begin(), lost.begin(), lost.end());
  }
  alternate_bridged(steps);
  detection.bridged = static_cast<std::size_t>(std::ranges::count(steps, true, &Step::bridged));
  detection.steps = std::move(steps);
  return detection;
}

}  // namespace vo
