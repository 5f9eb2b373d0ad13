#include "vo/gait/pvo_steps.hpp"

#include "vo/base/clock.hpp"
#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vo {
namespace {

/// ratio * median(differences of the last steps); 0 with fewer than two.
double dynamic_threshold(const std::vector<Step>& steps, const PublishedStepOptions& options) {
  std::vector<double> differences;
  for (std::size_t i = steps.size(); i > 1 && differences.size() + 1 < options.last_steps; --i)
    differences.push_back(std::abs(steps[i - 1].value - steps[i - 2].value));
  return differences.empty() ? 0 : options.delta_dyn_ratio * median(std::move(differences));
}

/// Steps alternate: of two with the same leg the larger is kept.
void add_step(std::vector<Step>& steps, const Step& step) {
  if (steps.empty() || steps.back().leg != step.leg)
    steps.push_back(step);
  else if (std::abs(step.value) > std::abs(steps.back().value))
    steps.back() = step;
}

}  // namespace

StepDetection detect_steps_as_published(std::span<const double> signal, std::span<const double> time_s,
                                        const PublishedStepOptions& options) {
  if (time_s.size() != signal.size())
    throw std::invalid_argument("detect_steps_as_published: one time per frame expected");
  if ((options.delta_min && !(*options.delta_min >= 0)) ||
      !(options.delta_min_ratio >= 0 && options.delta_dyn_ratio >= 0))
    throw std::invalid_argument("detect_steps_as_published: thresholds >= 0 expected");
  if (options.last_steps < 2)
    throw std::invalid_argument("detect_steps_as_published: last_steps >= 2 expected");
  StepDetection result{.delta_min = options.delta_min};
  result.delta_dyn.assign(signal.size(), 0);
  if (signal.size() < 3) return result;
  if (!result.delta_min) {
    const auto average = gait_amplitude(stride_periodicity(signal, frame_rate_hz(time_s)));
    result.delta_min = options.delta_min_ratio * average.value_or(0);
  }

  auto drawn = result.delta_dyn.begin();
  double delta_dyn = 0;
  for (const Step& extremum : signed_extrema(signal, time_s)) {
    const double value = std::abs(extremum.value);
    if (value < *result.delta_min) continue;
    const auto here = result.delta_dyn.begin() + static_cast<std::ptrdiff_t>(extremum.frame);
    std::fill(drawn, here, delta_dyn);
    drawn = here;
    delta_dyn = dynamic_threshold(result.steps, options);
    if (value > delta_dyn) add_step(result.steps, extremum);
  }
  std::fill(drawn, result.delta_dyn.end(), delta_dyn);
  return result;
}

}  // namespace vo
