#pragma once

#include "lanes/lanes.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <immintrin.h>

namespace vo::lanes {

/// AVX-512 F and BW.
struct Avx512 {
  static constexpr int kCount = 16;
  using Float = __m512;
  using Int = __m512i;

  static Float load(const float* from) { return _mm512_loadu_ps(from); }
  static void store(float* to, Float a) { _mm512_storeu_ps(to, a); }
  static Float all(float a) { return _mm512_set1_ps(a); }
  static Float add(Float a, Float b) { return _mm512_add_ps(a, b); }
  static Float sub(Float a, Float b) { return _mm512_sub_ps(a, b); }
  static Float mul(Float a, Float b) { return _mm512_mul_ps(a, b); }
  static Float min(Float a, Float b) { return _mm512_min_ps(a, b); }
  static Float max(Float a, Float b) { return _mm512_max_ps(a, b); }
  static Float abs(Float a) { return _mm512_abs_ps(a); }
  static Float sqrt(Float a) { return _mm512_sqrt_ps(a); }
  static float least(Float a) { return _mm512_reduce_min_ps(a); }

  static Int load(const std::uint32_t* from) { return _mm512_loadu_si512(from); }
  static void store(std::uint32_t* to, Int a) { _mm512_storeu_si512(to, a); }
  static Int all(std::uint32_t a) { return _mm512_set1_epi32(static_cast<int>(a)); }
  static Int add(Int a, Int b) { return _mm512_add_epi32(a, b); }
  static Int sub(Int a, Int b) { return _mm512_sub_epi32(a, b); }
  static Int min(Int a, Int b) { return _mm512_min_epi32(a, b); }
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
    keep_in_register(all);
    return all;
  }
  static Int add_products(Int sums, Products left, Products right) {
    return _mm512_add_epi32(sums, _mm512_madd_epi16(left, right));
  }

  using Bytes = __m512i;
  using Sums = __m512i;  // eight of 64 bits
  static constexpr std::size_t kBytes = 64;
  static Bytes load_bytes(const std::uint8_t* from) { return _mm512_loadu_si512(from); }
  static Bytes load_last(const std::uint8_t* end, std::size_t count) {
    return _mm512_maskz_loadu_epi8((__mmask64{1} << count) - 1, end - count);
  }
  static Sums no_sums() { return _mm512_setzero_si512(); }
  static Sums add_differences(Sums sums, Bytes a, Bytes b) {
    return _mm512_add_epi64(sums, _mm512_sad_epu8(a, b));
  }
  static std::int32_t total(Sums sums) { return static_cast<std::int32_t>(_mm512_reduce_add_epi64(sums)); }

  /// Else GCC reads values from memory again for each use, or keeps copies there.
  static void keep_in_register(__m512i& values) { asm("" : "+v"(values)); }
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
