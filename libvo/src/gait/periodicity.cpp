#include "vo/gait/periodicity.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace vo {
namespace {

/// The correlation of a signal with itself `lag` values later, -1 to 1; 0 where one of the two is constant 0.
double correlation(std::span<const double> x, std::size_t lag) {
  const auto early = x.first(x.size() - lag);
  const auto late = x.subspan(lag);
  const double power = std::sqrt(std::inner_product(early.begin(), early.end(), early.begin(), 0.0) *
                                 std::inner_product(late.begin(), late.end(), late.begin(), 0.0));
  return power > 0 ? std::inner_product(early.begin(), early.end(), late.begin(), 0.0) / power : 0;
}

/// A stretch of the signal, clipped at twice the upper quartile of its absolute values: a sinusoid is
/// unchanged, but a few wild values do not outweigh the rest.
std::vector<double> without_outliers(std::span<const double> signal) {
  std::vector<double> size(signal.size());
  std::ranges::transform(signal, size.begin(), [](double value) { return std::abs(value); });
  const auto quartile = size.begin() + static_cast<std::ptrdiff_t>(size.size() * 3 / 4);
  std::ranges::nth_element(size, quartile);
  const double limit = 2 * *quartile;
  std::vector<double> cut(signal.begin(), signal.end());
  for (double& value : cut) value = std::clamp(value, -limit, limit);
  return cut;
}

Periodicity periodicity_of(std::span<const double> signal, double rate_hz,
                           const PeriodicityOptions& options) {
  const std::vector<double> window = without_outliers(signal);
  Periodicity result;
  result.amplitude = std::sqrt(2 * std::inner_product(window.begin(), window.end(), window.begin(), 0.0) /
                               static_cast<double>(window.size()));
  const auto shortest =
      static_cast<std::size_t>(std::max(2.0, std::floor(2 * rate_hz / options.max_step_hz + 1e-6)));
  const auto longest = std::min(
      window.size() / 2, static_cast<std::size_t>(std::ceil(2 * rate_hz / options.min_step_hz - 1e-6)));
  if (longest < shortest) return result;

  // Half a stride with an odd number of frames lies between two lags.
  std::vector<double> r(longest + 1);
  for (std::size_t lag = shortest / 2; lag <= longest; ++lag) r[lag] = correlation(window, lag);
  std::vector<double> strength;
  for (std::size_t lag = shortest; lag <= longest; ++lag)
    strength.push_back((r[lag] - (r[lag / 2] + r[(lag + 1) / 2]) / 2) / 2);

  const double best = *std::ranges::max_element(strength);
  const auto at = [&](std::size_t i) { return i < strength.size() ? strength[i] : -2; };
  std::size_t i = 0;
  while (strength[i] < best - std::abs(best) / 10 || at(i - 1) > strength[i] || at(i + 1) > strength[i]) ++i;
  result.strength = strength[i];
  result.step_s = static_cast<double>(shortest + i) / rate_hz / 2;
  return result;
}

}  // namespace

std::vector<Periodicity> stride_periodicity(std::span<const double> signal, double rate_hz,
                                            const PeriodicityOptions& options) {
  if (!(rate_hz > 0 && options.window_s > 0 && options.hop_s > 0 && options.min_step_hz > 0))
    throw std::invalid_argument("stride_periodicity: rate, window, hop and steps above 0 expected");
  if (!(options.min_step_hz < options.max_step_hz))
    throw std::invalid_argument("stride_periodicity: min_step_hz below max_step_hz expected");
  constexpr double kRounding = 1e-6;  // of rates that are means
  std::vector<Periodicity> windows;
  const std::size_t frames = signal.size();
  const std::size_t length = std::min(
      frames, std::max<std::size_t>(1, static_cast<std::size_t>(options.window_s * rate_hz + kRounding)));
  const auto hop = static_cast<std::size_t>(std::max(1.0, std::round(options.hop_s * rate_hz)));
  for (std::size_t frame = 0; frame < frames; frame += hop) {
    const std::size_t begin = std::min(frame - std::min(frame, length / 2), frames - length);
    windows.push_back(periodicity_of(signal.subspan(begin, length), rate_hz, options));
    windows.back().frame = frame;
    windows.back().reach = length / 2;
  }
  for (std::size_t begin = 0, end = 0; begin < windows.size(); begin = end + 1) {
    const auto like_gait = [&](const Periodicity& window) {
      return window.strength >= options.min_strength && window.amplitude >= options.min_amplitude;
    };
    for (end = begin; end < windows.size() && like_gait(windows[end]);) ++end;
    const bool lasts =
        static_cast<double>(end - begin) * static_cast<double>(hop) >= options.min_gait_s * rate_hz;
    for (std::size_t i = begin; i < end; ++i) windows[i].gait = lasts;
  }
  return windows;
}

std::optional<double> gait_amplitude(std::span<const Periodicity> windows) {
  std::vector<double> amplitudes;
  double power = 0;
  for (const Periodicity& window : windows) {
    if (!window.gait) continue;
    amplitudes.push_back(window.amplitude);
    power += window.amplitude * window.amplitude;
  }
  std::ranges::sort(amplitudes);
  double below = 0;
  for (const double amplitude : amplitudes) {
    below += amplitude * amplitude;
    if (below >= power / 2) return amplitude;
  }
  return std::nullopt;
}

std::vector<double> local_gait_amplitude(std::span<const Periodicity> windows, std::size_t frames) {
  std::vector<double> local(frames, 0);
  std::vector<double> covering;
  for (std::size_t frame = 0, first = 0; frame < frames; ++frame) {
    while (first < windows.size() && windows[first].frame + windows[first].reach < frame) ++first;
    covering.clear();
    for (std::size_t i = first; i < windows.size() && windows[i].frame <= frame + windows[i].reach; ++i)
      if (windows[i].gait) covering.push_back(windows[i].amplitude);
    if (covering.empty()) continue;
    local[frame] = median(covering);
  }
  return local;
}

const Periodicity& nearest_window(std::span<const Periodicity> windows, std::size_t frame) {
  if (windows.empty()) throw std::invalid_argument("nearest_window: a window expected");
  const std::size_t hop = windows.size() > 1 ? windows[1].frame : 1;
  return windows[std::min((frame + hop / 2) / hop, windows.size() - 1)];
}

double sinusoid_amplitude(std::span<const double> signal, std::size_t frame, std::size_t reach) {
  const std::size_t begin = frame - std::min(frame, reach);
  const auto part = signal.subspan(begin, std::min(signal.size(), frame + reach + 1) - begin);
  return std::sqrt(2 * std::inner_product(part.begin(), part.end(), part.begin(), 0.0) /
                   static_cast<double>(part.size()));
}

}  // namespace vo
