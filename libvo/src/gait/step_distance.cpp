#include "vo/gait/step_distance.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace vo {
namespace {

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// From one step to the next.
struct Interval {
  double middle_s = 0;
  double seconds = 0;
  double growth = 0;  ///< mean of its frames
};

/// The usual step at a time: medians of those nearest to it. For times that increase from call to call.
class UsualStep {
 public:
  explicit UsualStep(const std::vector<Interval>& all) : all_(all) {}

  Interval at(double time_s) {
    constexpr std::size_t kNearest = 6;
    while (begin_ + kNearest < all_.size() &&
           all_[begin_ + kNearest].middle_s - time_s < time_s - all_[begin_].middle_s)
      ++begin_;
    const auto usual = [&](double Interval::*field) {
      std::vector<double> values;
      for (std::size_t i = begin_; i < std::min(all_.size(), begin_ + kNearest); ++i)
        values.push_back(all_[i].*field);
      return median(std::move(values));
    };
    return {time_s, usual(&Interval::seconds), usual(&Interval::growth)};
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
    all.push_back({.middle_s = (time_s[from] + time_s[to]) / 2,
                   .seconds = time_s[to] - time_s[from],
                   .growth = mean(growth.subspan(from + 1, to - from))});
  }
  // A step of a walker who slows down is longer than those before, but not than those after.
  constexpr std::ptrdiff_t kBeside = 3;
  const auto median_s = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::vector<double> seconds;
    for (auto i = std::max<std::ptrdiff_t>(0, begin); i < std::min(std::ssize(all), end); ++i)
      seconds.push_back(all[static_cast<std::size_t>(i)].seconds);
    return seconds.empty() ? 0 : median(std::move(seconds));
  };
  for (std::ptrdiff_t i = 0; i < std::ssize(all); ++i) {
    const Interval& step = all[static_cast<std::size_t>(i)];
    const double usual_s = std::max(median_s(i - kBeside, i + 1), median_s(i, i + kBeside + 1));
    if (step.seconds < missed_ratio * usual_s) whole.push_back(step);
  }
  return whole;
}

/// Gives each bridged step the opposite leg to the step next to it.
void alternate_bridged(std::vector<Step>& steps) {
  const auto other = [](Leg leg) { return leg == Leg::kLeft ? Leg::kRight : Leg::kLeft; };
  const auto seen = std::ranges::find(steps, false, &Step::bridged);
  for (auto step = seen; step != steps.begin(); --step) std::prev(step)->leg = other(step->leg);
  for (auto step = seen; step != steps.end(); ++step)
    if (step->bridged) step->leg = other(std::prev(step)->leg);
}

}  // namespace

StepDistance::StepDistance(std::span<const double> growth, std::span<const double> time_s,
                           std::span<const std::size_t> step_frames, const StepDistanceOptions& options)
    : time_s_(time_s), options_(options) {
  const std::vector<Interval> steps = whole_steps(growth, time_s, step_frames, options.missed_ratio);
  if (steps.empty()) return;
  std::vector<double> speed, over_step;  // shares of the usual growth: at the frame, and over a step around
                                         // it
  UsualStep about(steps);
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const Interval usual = about.at(time_s[i]);
    step_s_.push_back(usual.seconds);
    const auto share = [&](double grows) { return usual.growth > 0 ? std::abs(grows) / usual.growth : 1; };
    const auto [begin, end] = within(i, usual.seconds / 2);
    over_step.push_back(share(mean(growth.subspan(begin, end - begin))));
    speed.push_back(over_step[i] < options.min_growth ? 0 : std::min(1.0, share(growth[i])));
  }
  walk_on(over_step, speed);
  steps_.push_back(0);
  for (std::size_t i = 1; i < time_s.size(); ++i)
    steps_.push_back(steps_.back() + std::sqrt(speed[i]) * (time_s[i] - time_s[i - 1]) / step_s_[i]);
}

void StepDistance::walk_on(std::span<const double> over_step, std::vector<double>& speed) const {
  const auto slow = [&](double share) { return share < options_.slow_growth; };
  for (auto begin = over_step.begin(); begin != over_step.end();) {
    begin = std::find_if(begin, over_step.end(), slow);
    const auto end = std::find_if_not(begin, over_step.end(), slow);
    if (begin != over_step.begin() && end != over_step.end()) {
      const auto from = static_cast<std::size_t>(begin - over_step.begin());
      const auto to = static_cast<std::size_t>(end - over_step.begin());
      if (time_s_[to] - time_s_[from] < options_.min_stand * step_s_[from])
        std::fill(speed.begin() + (begin - over_step.begin()), speed.begin() + (end - over_step.begin()),
                  1.0);
    }
    begin = end;
  }
}

std::pair<std::size_t, std::size_t> StepDistance::within(std::size_t frame, double seconds) const {
  std::size_t begin = frame, end = frame + 1;
  while (begin > 0 && time_s_[frame] - time_s_[begin - 1] <= seconds) --begin;
  while (end < time_s_.size() && time_s_[end] - time_s_[frame] <= seconds) ++end;
  return {begin, end};
}

bool StepDistance::walking(std::size_t frame) const {
  const auto [begin, end] = within(frame, step_s_[frame] / 2);
  return between(begin, end - 1) >= options_.min_distance;
}

bool StepDistance::gap(std::size_t a, std::size_t b) const {
  return time_s_[b] - time_s_[a] > options_.missed_ratio * step_s_[b];
}

std::size_t StepDistance::after(std::size_t frame, double steps) const {
  const auto reached = std::ranges::lower_bound(steps_, steps_[frame] + steps - 1e-9);  // rounding
  return std::min(static_cast<std::size_t>(reached - steps_.begin()), steps_.size() - 1);
}

StepDetection complete_steps(StepDetection detection, const StepDistance& walked,
                             std::span<const double> signal, std::span<const double> time_s) {
  if (!walked.known() || detection.steps.empty()) return detection;
  std::vector<Step> steps;
  const auto add_lost = [&](std::size_t frame) {
    steps.push_back({frame, time_s[frame], Leg::kLeft, signal[frame], true});
  };
  // Up to a step lies between an end of the recording and the nearest footfall; distance is known only to a
  // quarter step.
  const auto lost = [](double steps_walked) { return std::max(0.0, std::floor(steps_walked - 0.25)); };

  const double before = walked.between(0, detection.steps.front().frame);
  for (double k = lost(before); k >= 1; --k) add_lost(walked.after(0, before - k));
  steps.push_back(detection.steps.front());
  for (const Step& step : std::span(detection.steps).subspan(1)) {
    const std::size_t from = steps.back().frame;
    const double length = walked.between(from, step.frame);
    const double count = walked.gap(from, step.frame) ? std::round(length) : 1;
    if (count >= 1) {
      for (double k = 1; k < count; ++k) add_lost(walked.after(from, length * k / count));
      steps.push_back(step);
    } else if (std::abs(step.value) > std::abs(steps.back().value)) {
      steps.back() = step;
    }
  }
  const std::size_t last = steps.back().frame;
  const double after = walked.between(last, time_s.size() - 1);
  for (double k = 1; k <= lost(after); ++k) add_lost(walked.after(last, k));

  detection.partial = {.first = std::min(1.0, walked.between(0, steps.front().frame)),
                       .after = std::min(1.0, walked.between(steps.back().frame, time_s.size() - 1))};
  alternate_bridged(steps);
  detection.bridged = static_cast<std::size_t>(std::ranges::count(steps, true, &Step::bridged));
  detection.steps = std::move(steps);
  return detection;
}

}  // namespace vo
