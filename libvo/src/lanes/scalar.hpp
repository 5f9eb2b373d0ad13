#pragma once

#include "lanes/lanes.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace vo::lanes {

/// One number at a time: what the others must equal.
struct Scalar {
  static constexpr std::size_t kCount = 1;
  using Float = float;
  using Int = std::uint32_t;

  static Float load(const float* from) { return *from; }
  static void store(float* to, Float a) { *to = a; }
  static Float all_float(float a) { return a; }
  static Float add(Float a, Float b) { return a + b; }
  static Float sub(Float a, Float b) { return a - b; }
  static Float mul(Float a, Float b) { return a * b; }
  static Float max(Float a, Float b) { return a > b ? a : b; }
  static Float abs(Float a) { return std::fabs(a); }
  static Float sqrt(Float a) { return std::sqrt(a); }

  static Int load(const std::int32_t* from) { return static_cast<Int>(*from); }
  static void store(std::int32_t* to, Int a) { *to = static_cast<std::int32_t>(a); }
  static Int add(Int a, Int b) { return a + b; }
  static Int sub(Int a, Int b) { return a - b; }
  /// Of signed integers, towards minus infinity.
  static Int half(Int a) { return static_cast<Int>(static_cast<std::int32_t>(a) >> 1); }
  static Float to_float(Int a) { return static_cast<float>(static_cast<std::int32_t>(a)); }
  /// To the nearest, of two the even.
  static Int to_nearest(Float a) { return static_cast<Int>(static_cast<std::int32_t>(std::lrint(a))); }

  static constexpr Packing kPacking{.group = 2, .left_offset = 0};
  using Products = std::uint32_t;
  static Products load_products(const void* from) {
    Products values;
    std::memcpy(&values, from, sizeof values);
    return values;
  }
  /// The 32 bits at `from` in every lane.
  static Products all_products(const void* from) { return load_products(from); }
  /// sums + the dot product of the values in each 32 bits.
  static Int add_products(Int sums, Products left, Products right) {
    const auto low = [](Products a) { return static_cast<std::int16_t>(a & 0xFFFFU); };
    const auto high = [](Products a) { return static_cast<std::int16_t>(a >> 16U); };
    return sums + static_cast<Int>(low(left) * low(right)) + static_cast<Int>(high(left) * high(right));
  }
};

}  // namespace vo::lanes
