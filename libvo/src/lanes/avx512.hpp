#pragma once

#include "lanes/lanes.hpp"

#include <cstdint>
#include <cstring>
#include <immintrin.h>

namespace vo::lanes {

/// AVX-512 F and BW.
struct Avx512 {
  static constexpr std::size_t kCount = 16;
  using Float = __m512;
  using Int = __m512i;

  static Float load(const float* from) { return _mm512_loadu_ps(from); }
  static void store(float* to, Float a) { _mm512_storeu_ps(to, a); }
  static Float all_float(float a) { return _mm512_set1_ps(a); }
  static Float add(Float a, Float b) { return _mm512_add_ps(a, b); }
  static Float sub(Float a, Float b) { return _mm512_sub_ps(a, b); }
  static Float mul(Float a, Float b) { return _mm512_mul_ps(a, b); }
  static Float max(Float a, Float b) { return _mm512_max_ps(a, b); }
  static Float abs(Float a) { return _mm512_abs_ps(a); }
  static Float sqrt(Float a) { return _mm512_sqrt_ps(a); }

  static Int load(const std::int32_t* from) { return _mm512_loadu_si512(from); }
  static void store(std::int32_t* to, Int a) { _mm512_storeu_si512(to, a); }
  static Int add(Int a, Int b) { return _mm512_add_epi32(a, b); }
  static Int sub(Int a, Int b) { return _mm512_sub_epi32(a, b); }
  static Int half(Int a) { return _mm512_srai_epi32(a, 1); }
  static Float to_float(Int a) { return _mm512_cvtepi32_ps(a); }
  static Int to_nearest(Float a) { return _mm512_cvtps_epi32(a); }

  static constexpr Packing kPacking{.group = 2, .left_offset = 0};
  using Products = __m512i;
  static Products load_products(const void* from) { return _mm512_loadu_si512(from); }
  static Products all_products(const void* from) {
    std::int32_t values;
    std::memcpy(&values, from, sizeof values);
    Products all = _mm512_set1_epi32(values);
    asm("" : "+v"(all));  // else GCC reads it from memory again for each use
    return all;
  }
  static Int add_products(Int sums, Products left, Products right) {
    return _mm512_add_epi32(sums, _mm512_madd_epi16(left, right));
  }
};

#if defined(__AVX512VNNI__)

/// And VNNI, whose products are of four bytes each, the left ones without sign.
struct Avx512Vnni : Avx512 {
  static constexpr Packing kPacking{.group = 4, .left_offset = 128};
  static Int add_products(Int sums, Products left, Products right) {
    return _mm512_dpbusd_epi32(sums, left, right);
  }
};

#endif

}  // namespace vo::lanes
