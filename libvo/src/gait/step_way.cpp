#include "vo/gait/step_way.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace vo {
namespace {

/// From one step to the next.
struct Interval {
  double middle_s = 0;
  double seconds = 0;
  double growth = 0;  ///< mean of its frames
};

/// The usual step about a time: medians of those nearest to it. For times that increase from call to call.
class UsualStep {
 public:
  explicit UsualStep(const std::vector<Interval>& all) : all_(all) {}

  Interval at(double time_s) {
    constexpr std::size_t kNearest = 6;
    while (begin_ + kNearest < all_.size() &&
           all_[begin_ + kNearest].middle_s - time_s < time_s - all_[begin_].middle_s)
      ++begin_;
    std::vector<double> seconds, growth;
    for (std::size_t i = begin_; i < std::min(all_.size(), begin_ + kNearest); ++i) {
      seconds.push_back(all_[i].seconds);
      growth.push_back(all_[i].growth);
    }
    return {.middle_s = time_s, .seconds = median(std::move(seconds)), .growth = median(std::move(growth))};
  }

 private:
  const std::vector<Interval>& all_;
  std::size_t begin_ = 0;
};

/// The intervals in which no step was lost.
std::vector<Interval> whole_steps(std::span<const double> growth, std::span<const double> time_s,
                                  std::span<const std::size_t> step_frames, double missed_ratio) {
  std::vector<Interval> all, whole;
  for (std::size_t i = 1; i < step_frames.size(); ++i) {
    const std::size_t from = step_frames[i - 1], to = step_frames[i];
    const auto part = growth.subspan(from + 1, to - from);
    all.push_back(
        {.middle_s = (time_s[from] + time_s[to]) / 2,
         .seconds = time_s[to] - time_s[from],
         .growth = std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(to - from)});
  }
  UsualStep usual(all);
  for (const Interval& step : all)
    if (step.seconds < missed_ratio * usual.at(step.middle_s).seconds) whole.push_back(step);
  return whole;
}

/// The mean over the time of a step about each frame.
std::vector<double> over_a_step(std::span<const double> values, std::span<const double> time_s,
                                std::span<const double> step_s) {
  std::vector<double> mean(values.size());
  for (std::size_t i = 0; i < mean.size(); ++i) {
    std::size_t begin = i, end = i + 1;
    while (begin > 0 && time_s[i] - time_s[begin - 1] <= step_s[i] / 2) --begin;
    while (end < mean.size() && time_s[end] - time_s[i] <= step_s[i] / 2) ++end;
    mean[i] = std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(begin),
                              values.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
              static_cast<double>(end - begin);
  }
  return mean;
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
    : time_s_(time_s), options_(options) {
  const std::vector<Interval> steps = whole_steps(growth, time_s, step_frames, options.missed_ratio);
  if (steps.empty()) return;
  std::vector<double> usual_growth;
  UsualStep usual(steps);
  for (const double now_s : time_s) {
    const Interval step = usual.at(now_s);
    step_s_.push_back(step.seconds);
    usual_growth.push_back(step.growth);
  }
  const std::vector<double> over_step = over_a_step(growth, time_s, step_s_);
  way_.assign(time_s.size(), 0);
  for (std::size_t i = 1; i < way_.size(); ++i) {
    double cadence = 1;  // share of the usual
    if (usual_growth[i] > 0) {
      const bool walks = over_step[i] >= options.min_growth * usual_growth[i];
      cadence = walks ? std::sqrt(std::clamp(growth[i] / usual_growth[i], 0.0, 1.0)) : 0;
    }
    way_[i] = way_[i - 1] + cadence * (time_s[i] - time_s[i - 1]) / step_s_[i];
  }
}

bool StepWay::walking(std::size_t frame) const {
  const double half_s = step_s_[frame] / 2;
  std::size_t a = frame, b = frame;
  while (a > 0 && time_s_[frame] - time_s_[a] < half_s) --a;
  while (b + 1 < time_s_.size() && time_s_[b] - time_s_[frame] < half_s) ++b;
  return between(a, b) >= options_.min_way;
}

bool StepWay::gap(std::size_t a, std::size_t b) const {
  return time_s_[b] - time_s_[a] > options_.missed_ratio * step_s_[b];
}

std::size_t StepWay::after(std::size_t frame, double steps) const {
  const auto reached = std::ranges::lower_bound(way_, way_[frame] + steps - 1e-9);  // of rounding
  return std::min(static_cast<std::size_t>(reached - way_.begin()), way_.size() - 1);
}

StepDetection complete_steps(StepDetection detection, const StepWay& way, std::span<const double> signal,
                             std::span<const double> time_s) {
  if (!way.known() || detection.steps.empty()) return detection;
  std::vector<Step> steps;
  const auto add_lost = [&](std::size_t frame) {
    steps.push_back({frame, time_s[frame], Leg::kLeft, signal[frame], true});
  };
  // Up to a step lies between an end of the recording and the footfall next to it; the way is known no better
  // than to a quarter.
  const auto lost = [](double steps_of_way) { return std::max(0.0, std::floor(steps_of_way - 0.25)); };

  const double before = way.between(0, detection.steps.front().frame);
  for (double k = lost(before); k >= 1; --k) add_lost(way.after(0, before - k));
  steps.push_back(detection.steps.front());
  for (const Step& step : std::span(detection.steps).subspan(1)) {
    const std::size_t from = steps.back().frame;
    const double length = way.between(from, step.frame);
    constexpr double kStand = 3;  // steps: to stop and start again takes no less time
    const double least = time_s[step.frame] - time_s[from] < kStand * way.step_s(step.frame) ? 1 : 0;
    const double count = way.gap(from, step.frame) ? std::max(least, std::round(length)) : 1;
    if (count >= 1) {
      for (double k = 1; k < count; ++k) add_lost(way.after(from, length * k / count));
      steps.push_back(step);
    } else if (std::abs(step.value_deg) > std::abs(steps.back().value_deg)) {
      steps.back() = step;
    }
  }
  const std::size_t last = steps.back().frame;
  const double after = way.between(last, time_s.size() - 1);
  for (double k = 1; k <= lost(after); ++k) add_lost(way.after(last, k));

  alternate_bridged(steps);
  detection.bridged = static_cast<std::size_t>(std::ranges::count(steps, true, &Step::bridged));
  detection.steps = std::move(steps);
  return detection;
}

}  // namespace vo
