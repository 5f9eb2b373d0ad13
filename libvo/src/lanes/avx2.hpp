#pragma once

#include "lanes/lanes.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <immintrin.h>

namespace vo::lanes {

struct Avx2 {
  static constexpr int kCount = 8;
  using Float = __m256;
  using Int = __m256i;

  static Float load(const float* from) { return _mm256_loadu_ps(from); }
  static void store(float* to, Float a) { _mm256_storeu_ps(to, a); }
  static Float all(float a) { return _mm256_set1_ps(a); }
  static Float add(Float a, Float b) { return _mm256_add_ps(a, b); }
  static Float sub(Float a, Float b) { return _mm256_sub_ps(a, b); }
  static Float mul(Float a, Float b) { return _mm256_mul_ps(a, b); }
  static Float div(Float a, Float b) { return _mm256_div_ps(a, b); }
  static Float min(Float a, Float b) { return _mm256_min_ps(a, b); }
  static Float max(Float a, Float b) { return _mm256_max_ps(a, b); }
  static Float abs(Float a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a); }
  static Float sqrt(Float a) { return _mm256_sqrt_ps(a); }
  static Float where_positive(Float sign, Float a) { return _mm256_blendv_ps(a, _mm256_setzero_ps(), sign); }
  static Float infinite_unless(Float sign, Float a) {
    return _mm256_blendv_ps(a, _mm256_set1_ps(kInfinity), sign);
  }
  static unsigned greater(Float a, Float b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_GT_OQ)));
  }
  static unsigned greater_equal(Float a, Float b) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_GE_OQ)));
  }
  static float sum(Float a) {
    const __m128 fours = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 twos = _mm_add_ps(fours, _mm_movehl_ps(fours, fours));
    return _mm_cvtss_f32(_mm_add_ss(twos, _mm_movehdup_ps(twos)));
  }
  static float least(Float a) {
    __m128 four = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    four = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(four, _mm_movehdup_ps(four)));
  }

  static Int load(const std::uint32_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static void store(std::uint32_t* to, Int a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a); }
  static Int all(std::uint32_t a) { return _mm256_set1_epi32(static_cast<int>(a)); }
  static Int add(Int a, Int b) { return _mm256_add_epi32(a, b); }
  static Int sub(Int a, Int b) { return _mm256_sub_epi32(a, b); }
  static Int mul(Int a, Int b) { return _mm256_mullo_epi32(a, b); }
  static Int min(Int a, Int b) { return _mm256_min_epi32(a, b); }
  static Int half(Int a) { return _mm256_srai_epi32(a, 1); }
  static Int low_half(Int a) { return _mm256_and_si256(a, _mm256_set1_epi32(0xFFFF)); }
  static Int high_half(Int a) { return _mm256_srli_epi32(a, 16); }
  static Float to_float(Int a) { return _mm256_cvtepi32_ps(a); }
  static Int to_int(Float a) { return _mm256_cvttps_epi32(a); }
  static Int to_nearest(Float a) { return _mm256_cvtps_epi32(a); }
  static Int pair_at(const std::uint16_t* from, Int index) {
    return _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), index, 2);
  }

  static constexpr Packing kPacking{.group = 2, .left_offset = 0};
  using Products = __m256i;
  static Products load_products(const void* from) {
    return _mm256_loadu_si256(static_cast<const __m256i*>(from));
  }
  static Products all_products(const void* from) {
    std::int32_t pair;
    std::memcpy(&pair, from, sizeof pair);
    Products all = _mm256_set1_epi32(pair);
    keep_in_register(all);
    return all;
  }
  static Int add_products(Int sums, Products left, Products right) {
    return _mm256_add_epi32(sums, _mm256_madd_epi16(left, right));
  }

  using Bytes = __m256i;
  using Sums = __m256i;  // four of 64 bits
  static constexpr std::size_t kBytes = 32;
  static Bytes load_bytes(const std::uint8_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static Bytes load_last(const std::uint8_t* end, std::size_t count) {
    const __m256i place = _mm256_setr_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18,
                                           19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31);
    const __m256i before = _mm256_set1_epi8(static_cast<char>(kBytes - count - 1));
    return _mm256_and_si256(load_bytes(end - kBytes), _mm256_cmpgt_epi8(place, before));
  }
  static Sums no_sums() { return _mm256_setzero_si256(); }
  static Sums add_differences(Sums sums, Bytes a, Bytes b) {
    return _mm256_add_epi64(sums, _mm256_sad_epu8(a, b));
  }
  static std::int32_t total(Sums sums) {
    const __m128i halves = _mm_add_epi64(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
    return static_cast<std::int32_t>(_mm_cvtsi128_si64(halves) + _mm_extract_epi64(halves, 1));
  }

  /// Else GCC reads values from memory again for each use, or keeps copies there.
  static void keep_in_register(__m256i& values) { asm("" : "+x"(values)); }
};

}  // namespace vo::lanes
