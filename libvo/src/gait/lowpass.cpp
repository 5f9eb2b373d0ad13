#include "vo/gait/lowpass.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace vo {

std::vector<double> bridge_gaps(std::span<const double> values, const std::vector<bool>& reliable) {
  if (values.size() != reliable.size())
    throw std::invalid_argument("bridge_gaps: one flag per value expected");
  std::vector<double> bridged(values.size(), 0);
  std::optional<std::size_t> before;  // the last reliable one
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!reliable[i]) {
      if (before) bridged[i] = values[*before];
      continue;
    }
    bridged[i] = values[i];
    for (std::size_t gap = before ? *before + 1 : 0; gap < i; ++gap) {
      const double share =
          before ? static_cast<double>(gap - *before) / static_cast<double>(i - *before) : 1.0;
      bridged[gap] = std::lerp(before ? values[*before] : values[i], values[i], share);
    }
    before = i;
  }
  return bridged;
}

Lowpass::Lowpass(double rate_hz, const LowpassOptions& options) {
  const auto [order, cutoff_hz] = options;
  if (order < 1 || order > 8)
    throw std::invalid_argument(fmt::format("low-pass order: is {}; 1 to 8 expected", order));
  if (!(cutoff_hz > 0) || !std::isfinite(cutoff_hz))
    throw std::invalid_argument(fmt::format("low-pass cut-off: is {} Hz; above 0 Hz expected", cutoff_hz));
  if (!(rate_hz > 2 * cutoff_hz) || !std::isfinite(rate_hz)) {
    throw std::invalid_argument(
        fmt::format("frame rate: is {:g} Hz; above {:g} Hz expected, twice the low-pass cut-off of {:g} Hz",
                    rate_hz, 2 * cutoff_hz, cutoff_hz));
  }
  // With s = (1 - z^-1) / (1 + z^-1) / k, each pair of poles is 1 / (s^2 + q s + 1) and a lone one 1 / (s +
  // 1).
  const double k = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
  for (int pair = 0; pair < order / 2; ++pair) {
    const double q = 2 * std::sin(std::numbers::pi * (2 * pair + 1) / (2 * order));
    const double norm = 1 / (1 + q * k + k * k);
    const double b = k * k * norm;
    sections_.push_back({.b = {b, 2 * b, b}, .a = {2 * (k * k - 1) * norm, (1 - q * k + k * k) * norm}});
  }
  if (order % 2 != 0) {
    const double b = k / (1 + k);
    sections_.push_back({.b = {b, b, 0}, .a = {(k - 1) / (k + 1), 0}});
  }
}

double Lowpass::push(double value) {
  if (!started_) {
    // The state in which a constant `value` comes out as `value`, as the gain at rest is 1.
    for (Section& section : sections_) {
      section.state[1] = (section.b[2] - section.a[1]) * value;
      section.state[0] = (section.b[1] - section.a[0]) * value + section.state[1];
    }
    started_ = true;
  }
  for (auto& [b, a, state] : sections_) {  // transposed direct form II
    const double out = b[0] * value + state[0];
    state[0] = b[1] * value - a[0] * out + state[1];
    state[1] = b[2] * value - a[1] * out;
    value = out;
  }
  return value;
}

std::vector<double> lowpass_zero_phase(std::span<const double> signal, double rate_hz,
                                       const LowpassOptions& options) {
  Lowpass forwards(rate_hz, options);
  Lowpass backwards(rate_hz, options);
  if (signal.empty()) return {};
  const std::size_t pad =
      std::min(signal.size() - 1, static_cast<std::size_t>(std::ceil(3 * rate_hz / options.cutoff_hz)));
  std::vector<double> extended;
  extended.reserve(signal.size() + 2 * pad);
  for (std::size_t i = pad; i > 0; --i) extended.push_back(2 * signal.front() - signal[i]);
  extended.insert(extended.end(), signal.begin(), signal.end());
  for (std::size_t i = 1; i <= pad; ++i)
    extended.push_back(2 * signal.back() - signal[signal.size() - 1 - i]);

  for (double& value : extended) value = forwards.push(value);
  for (auto value = extended.rbegin(); value != extended.rend(); ++value) *value = backwards.push(*value);
  const auto begin = extended.begin() + static_cast<std::ptrdiff_t>(pad);
  return {begin, begin + static_cast<std::ptrdiff_t>(signal.size())};
}

std::vector<double> without_drift(std::span<const double> signal, double rate_hz, double slowest_hz) {
  std::vector<double> rest = lowpass_zero_phase(signal, rate_hz, {.order = 2, .cutoff_hz = slowest_hz});
  std::ranges::transform(signal, rest, rest.begin(), std::minus{});
  return rest;
}

}  // namespace vo
