#pragma once

#include "lanes/lanes.hpp"

#include <cstdint>
#include <cstring>
#include <immintrin.h>

namespace vo::lanes {

struct Avx2 {
  static constexpr std::size_t kCount = 8;
  using Float = __m256;
  using Int = __m256i;

  static Float load(const float* from) { return _mm256_loadu_ps(from); }
  static void store(float* to, Float a) { _mm256_storeu_ps(to, a); }
  static Float all_float(float a) { return _mm256_set1_ps(a); }
  static Float add(Float a, Float b) { return _mm256_add_ps(a, b); }
  static Float sub(Float a, Float b) { return _mm256_sub_ps(a, b); }
  static Float mul(Float a, Float b) { return _mm256_mul_ps(a, b); }
  static Float max(Float a, Float b) { return _mm256_max_ps(a, b); }
  static Float abs(Float a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a); }
  static Float sqrt(Float a) { return _mm256_sqrt_ps(a); }

  static Int load(const std::int32_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static void store(std::int32_t* to, Int a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a); }
  static Int add(Int a, Int b) { return _mm256_add_epi32(a, b); }
  static Int sub(Int a, Int b) { return _mm256_sub_epi32(a, b); }
  static Int half(Int a) { return _mm256_srai_epi32(a, 1); }
  static Float to_float(Int a) { return _mm256_cvtepi32_ps(a); }
  static Int to_nearest(Float a) { return _mm256_cvtps_epi32(a); }

  static constexpr Packing kPacking{.group = 2, .left_offset = 0};
  using Products = __m256i;
  static Products load_products(const void* from) {
    return _mm256_loadu_si256(static_cast<const __m256i*>(from));
  }
  static Products all_products(const void* from) {
    std::int32_t pair;
    std::memcpy(&pair, from, sizeof pair);
    Products all = _mm256_set1_epi32(pair);
    asm("" : "+x"(all));  // else GCC reads it from memory again for each use
    return all;
  }
  static Int add_products(Int sums, Products left, Products right) {
    return _mm256_add_epi32(sums, _mm256_madd_epi16(left, right));
  }
};

}  // namespace vo::lanes
