#include "vo/base/rng.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace vo {

std::uint64_t Rng::bits() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

double Rng::uniform() {
  return static_cast<double>(bits() >> 11U) * 0x1.0p-53;
}

double Rng::uniform(double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high) || low > high) {
    throw std::invalid_argument("Rng::uniform: low <= high, both finite, expected");
  }
  return low + (high - low) * uniform();
}

std::uint64_t Rng::index(std::uint64_t count) {
  if (count == 0) throw std::invalid_argument("Rng::index: count must be >= 1");
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t limit = kMax - kMax % count;
  std::uint64_t value = bits();
  while (value >= limit) value = bits();
  return value % count;
}

double Rng::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

Rng Rng::split() {
  return Rng(bits() ^ 0x5851f42d4c957f2dU);
}

}  // namespace vo
