#pragma once

#include "lanes/lanes.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace vo::lanes {

/// Plain loops over as many numbers as the kernel is written for: what the others must equal.
template <int kWidth>
struct Plain {
  static constexpr int kCount = kWidth;
  struct Float {
    float v[kCount];
  };
  struct Int {
    std::uint32_t v[kCount];
  };

  static Float load(const float* from) {
    return each<Float>([&](int i) { return from[i]; });
  }
  static void store(float* to, Float a) {
    for (int i = 0; i < kCount; ++i) to[i] = a.v[i];
  }
  static Float all(float a) {
    return each<Float>([&](int) { return a; });
  }
  static Float add(Float a, Float b) {
    return each<Float>([&](int i) { return a.v[i] + b.v[i]; });
  }
  static Float sub(Float a, Float b) {
    return each<Float>([&](int i) { return a.v[i] - b.v[i]; });
  }
  static Float mul(Float a, Float b) {
    return each<Float>([&](int i) { return a.v[i] * b.v[i]; });
  }
  static Float div(Float a, Float b) {
    return each<Float>([&](int i) { return a.v[i] / b.v[i]; });
  }
  static Float min(Float a, Float b) {
    return each<Float>([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
  }
  static Float max(Float a, Float b) {
    return each<Float>([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
  }
  static Float abs(Float a) {
    return each<Float>([&](int i) { return std::fabs(a.v[i]); });
  }
  static Float sqrt(Float a) {
    return each<Float>([&](int i) { return std::sqrt(a.v[i]); });
  }
  static Float where_positive(Float sign, Float a) {
    return each<Float>([&](int i) { return std::signbit(sign.v[i]) ? 0.0F : a.v[i]; });
  }
  static Float infinite_unless(Float sign, Float a) {
    return each<Float>([&](int i) { return std::signbit(sign.v[i]) ? kInfinity : a.v[i]; });
  }
  static unsigned greater(Float a, Float b) {
    unsigned bits = 0;
    for (int i = 0; i < kCount; ++i) bits |= static_cast<unsigned>(a.v[i] > b.v[i]) << i;
    return bits;
  }
  static unsigned greater_equal(Float a, Float b) {
    unsigned bits = 0;
    for (int i = 0; i < kCount; ++i) bits |= static_cast<unsigned>(a.v[i] >= b.v[i]) << i;
    return bits;
  }
  static float sum(Float a) {
    static_assert(kCount == 8);
    return ((a.v[0] + a.v[4]) + (a.v[2] + a.v[6])) + ((a.v[1] + a.v[5]) + (a.v[3] + a.v[7]));
  }
  static float least(Float a) {
    float least = a.v[0];
    for (int i = 1; i < kCount; ++i) least = a.v[i] < least ? a.v[i] : least;
    return least;
  }

  static Int load(const std::uint32_t* from) {
    return each<Int>([&](int i) { return from[i]; });
  }
  static void store(std::uint32_t* to, Int a) {
    for (int i = 0; i < kCount; ++i) to[i] = a.v[i];
  }
  static Int all(std::uint32_t a) {
    return each<Int>([&](int) { return a; });
  }
  static Int add(Int a, Int b) {
    return each<Int>([&](int i) { return a.v[i] + b.v[i]; });
  }
  static Int sub(Int a, Int b) {
    return each<Int>([&](int i) { return a.v[i] - b.v[i]; });
  }
  static Int mul(Int a, Int b) {
    return each<Int>([&](int i) { return a.v[i] * b.v[i]; });
  }
  static Int min(Int a, Int b) {
    return each<Int>([&](int i) { return as_signed(a.v[i]) < as_signed(b.v[i]) ? a.v[i] : b.v[i]; });
  }
  static Int half(Int a) {
    return each<Int>([&](int i) { return static_cast<std::uint32_t>(as_signed(a.v[i]) >> 1); });
  }
  static Int low_half(Int a) {
    return each<Int>([&](int i) { return a.v[i] & 0xFFFFU; });
  }
  static Int high_half(Int a) {
    return each<Int>([&](int i) { return a.v[i] >> 16U; });
  }
  static Float to_float(Int a) {
    return each<Float>([&](int i) { return static_cast<float>(as_signed(a.v[i])); });
  }
  static Int to_int(Float a) {
    return each<Int>([&](int i) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(a.v[i])); });
  }
  static Int to_nearest(Float a) {
    return each<Int>(
        [&](int i) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lrint(a.v[i]))); });
  }
  static Int pair_at(const std::uint16_t* from, Int index) {
    return each<Int>([&](int i) { return from[index.v[i]] | std::uint32_t{from[index.v[i] + 1]} << 16U; });
  }

  static constexpr Packing kPacking{.group = 2, .left_offset = 0};
  using Products = Int;
  static Products load_products(const void* from) {
    Products values;
    std::memcpy(&values, from, sizeof values);
    return values;
  }
  static Products all_products(const void* from) {
    std::uint32_t pair;
    std::memcpy(&pair, from, sizeof pair);
    return all(pair);
  }
  static Int add_products(Int sums, Products left, Products right) {
    const auto value = [](std::uint32_t pair, unsigned shift) {
      return static_cast<std::int16_t>((pair >> shift) & 0xFFFFU);
    };
    return each<Int>([&](int i) {
      const std::uint32_t a = left.v[i], b = right.v[i];
      return sums.v[i] + static_cast<std::uint32_t>(value(a, 0) * value(b, 0)) +
             static_cast<std::uint32_t>(value(a, 16) * value(b, 16));
    });
  }

 private:
  template <class Value, class Function>
  static Value each(Function function) {
    Value result;
    for (int i = 0; i < kCount; ++i) result.v[i] = function(i);
    return result;
  }
  static std::int32_t as_signed(std::uint32_t a) { return static_cast<std::int32_t>(a); }
};

/// One number at a time.
using Scalar = Plain<1>;

}  // namespace vo::lanes
