#pragma once

#include <cstdint>

namespace vo {

/// A small seeded generator whose numbers are the same with every compiler and standard library, unlike the
/// distributions of <random>. SplitMix64: Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", 2014.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : state_(seed) {}

  /// The next 64 random bits.
  std::uint64_t bits();

  /// Uniform in [0, 1) with 53 random bits.
  double uniform();

  /// Uniform in [low, high). Throws `std::invalid_argument` unless low <= high and both are finite.
  double uniform(double low, double high);

  /// Uniform in {0, ..., count - 1}, unbiased. Throws `std::invalid_argument` if count is 0.
  std::uint64_t index(std::uint64_t count);

  /// Normal with mean 0 and standard deviation 1 (Box-Muller).
  double normal();

  /// A generator with an independent stream, for a part that must not depend on how many numbers others draw.
  Rng split();

 private:
  std::uint64_t state_;
};

}  // namespace vo
