#include "vo/gait/step_fusion.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace vo {

StepDetection fill_steps(const StepDetection& orientation, const StepDetection& shift,
                         std::span<const std::size_t> matches, std::span<const double> time_s,
                         const StepFusionOptions& options) {
  if (matches.size() != time_s.size()) throw std::invalid_argument("fill_steps: one time per frame expected");
  StepDetection filled = orientation;
  if (matches.empty() || orientation.steps.empty()) return filled;
  const double few = options.few_matches * median(std::vector<double>(matches.begin(), matches.end()));

  const auto mostly_poor = [&](double at_s) {
    std::size_t frames = 0, poor = 0;
    auto frame = static_cast<std::size_t>(std::ranges::lower_bound(time_s, at_s - options.span_s / 2) -
                                          time_s.begin());
    for (; frame < time_s.size() && time_s[frame] <= at_s + options.span_s / 2; ++frame) {
      ++frames;
      poor += static_cast<double>(matches[frame]) < few ? 1 : 0;
    }
    return 2 * poor > frames;
  };
  const auto lonely = [&](double at_s) {
    return std::ranges::none_of(
        orientation.steps, [&](const Step& step) { return std::abs(step.time_s - at_s) < options.apart_s; });
  };
  for (const Step& step : shift.steps) {
    if (!mostly_poor(step.time_s) || !lonely(step.time_s)) continue;
    const auto after = std::ranges::upper_bound(filled.steps, step.frame, {}, &Step::frame);
    Step taken = step;
    if (after != filled.steps.begin())
      taken.leg = std::prev(after)->leg == Leg::kLeft ? Leg::kRight : Leg::kLeft;
    filled.bridged += taken.bridged ? 1 : 0;
    filled.steps.insert(after, taken);
  }
  return filled;
}

}  // namespace vo
