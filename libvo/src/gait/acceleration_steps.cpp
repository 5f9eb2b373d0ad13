#include "vo/gait/acceleration_steps.hpp"

#include "vo/gait/lowpass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>

namespace vo {
namespace {

constexpr double kRate_hz = 50;
constexpr double kWindow_s = 4, kHop_s = 0.5;
constexpr double kShortest_s = 1 / 3.5, kLongest_s = 1 / 0.8;  // of a step: human cadence
constexpr double kNearlyBest = 0.85, kRegular = 0.4;           // correlations
constexpr double kDeviation_m_s2 = 0.5;  // a phone in the hand of who stands has a tenth
constexpr double kApart = 0.6;           // of a period

/// The values at an even rate, linear between them.
std::vector<double> evenly(std::span<const double> values, std::span<const double> time_s) {
  std::vector<double> even;
  const auto count = static_cast<std::size_t>((time_s.back() - time_s.front()) * kRate_hz) + 1;
  for (std::size_t i = 0, at = 0; i < count; ++i) {
    const double t = time_s.front() + static_cast<double>(i) / kRate_hz;
    while (at + 2 < time_s.size() && time_s[at + 1] < t) ++at;
    const double share = std::clamp((t - time_s[at]) / (time_s[at + 1] - time_s[at]), 0., 1.);
    even.push_back(std::lerp(values[at], values[at + 1], share));
  }
  return even;
}

/// After how many samples a window of the signal repeats; 0 if it does not.
double period_of(std::span<const double> window) {
  double power = 0;
  for (const double value : window) power += value * value;
  if (!(power > 0)) return 0;
  const auto correlation = [&](std::size_t lag) {
    double product = 0, first = 0, second = 0;
    for (std::size_t i = lag; i < window.size(); ++i) {
      product += window[i] * window[i - lag];
      first += window[i] * window[i];
      second += window[i - lag] * window[i - lag];
    }
    const double scale = std::sqrt(first * second);
    return scale > 0 ? product / scale : 0;
  };
  const auto shortest = static_cast<std::size_t>(std::floor(kShortest_s * kRate_hz));
  const auto longest = static_cast<std::size_t>(std::ceil(kLongest_s * kRate_hz));
  std::vector<double> at;
  for (std::size_t lag = shortest - 1; lag <= longest + 1; ++lag) at.push_back(correlation(lag));
  double best = 0;
  for (std::size_t i = 1; i + 1 < at.size(); ++i)
    if (at[i] >= at[i - 1] && at[i] >= at[i + 1]) best = std::max(best, at[i]);
  if (best < kRegular) return 0;
  for (std::size_t i = 1; i + 1 < at.size(); ++i) {
    if (at[i] < at[i - 1] || at[i] < at[i + 1] || at[i] < kNearlyBest * best) continue;
    return static_cast<double>(shortest - 1 + i);
  }
  return 0;
}

}  // namespace

std::vector<double> acceleration_steps(std::span<const double> acceleration_m_s2,
                                       std::span<const double> time_s) {
  if (acceleration_m_s2.size() != time_s.size())
    throw std::invalid_argument("acceleration_steps: one time per value expected");
  if (std::ranges::adjacent_find(time_s, std::greater_equal<>()) != time_s.end())
    throw std::invalid_argument("acceleration_steps: increasing times expected");
  if (time_s.size() < 2 || time_s.back() - time_s.front() < kWindow_s) return {};
  constexpr double kSlowest_hz = 0.5, kFastest_hz = 4;
  const std::vector<double> even = evenly(acceleration_m_s2, time_s);
  const std::vector<double> smooth =
      lowpass_zero_phase(without_drift(even, kRate_hz, kSlowest_hz), kRate_hz, {.cutoff_hz = kFastest_hz});

  constexpr auto kWindow = static_cast<std::size_t>(kWindow_s * kRate_hz);
  constexpr auto kHop = static_cast<std::size_t>(kHop_s * kRate_hz);
  std::vector<double> period;  // of the window about each hop
  for (std::size_t middle = 0; middle < smooth.size(); middle += kHop) {
    const std::size_t begin =
        std::min(middle < kWindow / 2 ? 0 : middle - kWindow / 2, smooth.size() - kWindow);
    period.push_back(period_of(std::span(smooth).subspan(begin, kWindow)));
  }
  const auto period_near = [&](std::size_t i) {
    return period[std::min((i + kHop / 2) / kHop, period.size() - 1)];
  };
  // Over the samples of a period about a peak: a walker who stops is still within a second.
  const auto deviation = [&](std::size_t i, double samples) {
    const auto half = static_cast<std::size_t>(samples / 2);
    const std::size_t begin = i < half ? 0 : i - half, end = std::min(i + half + 1, smooth.size());
    double power = 0;
    for (std::size_t k = begin; k < end; ++k) power += smooth[k] * smooth[k];
    return std::sqrt(power / static_cast<double>(end - begin));
  };
  std::vector<std::size_t> peaks;
  for (std::size_t i = 1; i + 1 < smooth.size(); ++i) {
    if (smooth[i] <= 0 || smooth[i] <= smooth[i - 1] || smooth[i] < smooth[i + 1]) continue;
    const double here = period_near(i);
    if (here > 0 && deviation(i, here) >= kDeviation_m_s2) peaks.push_back(i);
  }
  std::ranges::stable_sort(peaks, std::greater<>(), [&](std::size_t i) { return smooth[i]; });
  std::set<std::size_t> steps;
  for (const std::size_t peak : peaks) {
    const auto apart = static_cast<std::size_t>(kApart * period_near(peak));
    const auto after = steps.lower_bound(peak);
    const bool free = (after == steps.end() || *after - peak >= apart) &&
                      (after == steps.begin() || peak - *std::prev(after) >= apart);
    if (free) steps.insert(peak);
  }
  std::vector<double> times_s;
  for (const std::size_t step : steps)
    times_s.push_back(time_s.front() + static_cast<double>(step) / kRate_hz);
  return times_s;
}

}  // namespace vo
