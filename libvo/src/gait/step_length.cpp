#include "vo/gait/step_length.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
std::optional<double> local_cadence_hz(std::span<const Step> steps, std::size_t i, double pause_s) {
  constexpr std::size_t kStride = 2;
  std::size_t first = i, last = i;
  while (first > 0 && i - first < kStride && steps[first].time_s - steps[first - 1].time_s <= pause_s)
    --first;
  while (last + 1 < steps.size() && last - i < kStride &&
         steps[last + 1].time_s - steps[last].time_s <= pause_s)
    ++last;
  if (first == last) return std::nullopt;
  return static_cast<double>(last - first) / (steps[last].time_s - steps[first].time_s);
}

double calibrated_step_length_m(double distance_m, double steps) {
  if (!(distance_m > 0 && steps > 0)) {
    throw std::invalid_argument(
        fmt::format("calibrated_step_length_m: {} m in {} steps; both above 0 expected", distance_m, steps));
  }
  return distance_m / steps;
}

std::vector<double> step_lengths_m(std::span<const Step> steps, const StepLengthOptions& options) {
  if (!(options.length_m > 0 && options.min_cadence_hz > 0 && options.pause_s > 0) ||
      !(options.reference_cadence_hz.value_or(1) > 0))
    throw std::invalid_argument("step_lengths_m: length, cadences and pause above 0 expected");
  if (!(options.min_cadence_hz <= options.max_cadence_hz))
    throw std::invalid_argument("step_lengths_m: min_cadence_hz <= max_cadence_hz expected");
  std::vector<double> lengths_m(steps.size(), options.length_m);
  if (options.model == StepLengthModel::kFixed) return lengths_m;

  const auto bounded = [&](double hz) {
    return std::clamp(hz, options.min_cadence_hz, options.max_cadence_hz);
  };
  std::vector<std::optional<double>> cadences(steps.size());
  double sum = 0, known = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    cadences[i] = local_cadence_hz(steps, i, options.pause_s);
    if (!cadences[i]) continue;
    cadences[i] = bounded(*cadences[i]);
    sum += *cadences[i];
    ++known;
  }
  const double reference =
      options.reference_cadence_hz ? bounded(*options.reference_cadence_hz) : sum / known;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (cadences[i]) lengths_m[i] *= *cadences[i] / reference;
  return lengths_m;
}

}  // namespace vo
