#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

/// Eight numbers at a time, twice: by plain loops and by AVX2. A kernel is written once, over either, so that
/// both do the same operations in the same order and give the same bits; nothing here contracts a product and
/// a sum. Included only by the sources of `kernels`.
namespace vo::kernels {

inline constexpr float kInfinity = __builtin_inff();

struct ScalarLanes {
  static constexpr int kCount = 8;

  struct Float {
    float v[kCount];
  };
  struct Int {
    std::uint32_t v[kCount];
  };

  template <class Value, class Function>
  static Value each(Function function) {
    Value result;
    for (int i = 0; i < kCount; ++i) result.v[i] = function(i);
    return result;
  }

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
  /// `a` where `sign` has no sign bit, else 0.
  static Float where_positive(Float sign, Float a) {
    return each<Float>([&](int i) { return std::signbit(sign.v[i]) ? 0.0F : a.v[i]; });
  }
  /// `a` where `sign` has no sign bit, else infinite.
  static Float infinite_unless(Float sign, Float a) {
    return each<Float>([&](int i) { return std::signbit(sign.v[i]) ? kInfinity : a.v[i]; });
  }
  /// One bit per lane.
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
  /// ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)).
  static float sum(Float a) {
    return ((a.v[0] + a.v[4]) + (a.v[2] + a.v[6])) + ((a.v[1] + a.v[5]) + (a.v[3] + a.v[7]));
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
  static Int low_half(Int a) {
    return each<Int>([&](int i) { return a.v[i] & 0xFFFFU; });
  }
  static Int high_half(Int a) {
    return each<Int>([&](int i) { return a.v[i] >> 16; });
  }
  /// Of signed integers.
  static Float to_float(Int a) {
    return each<Float>([&](int i) { return static_cast<float>(static_cast<std::int32_t>(a.v[i])); });
  }
  /// Towards zero.
  static Int to_int(Float a) {
    return each<Int>([&](int i) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(a.v[i])); });
  }
  /// from[index] in the low half, from[index + 1] in the high.
  static Int pair_at(const std::uint16_t* from, Int index) {
    return each<Int>([&](int i) { return from[index.v[i]] | std::uint32_t{from[index.v[i] + 1]} << 16; });
  }
};

#if defined(__AVX2__)

struct Avx2Lanes {
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

  static Int load(const std::uint32_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static void store(std::uint32_t* to, Int a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a); }
  static Int all(std::uint32_t a) { return _mm256_set1_epi32(static_cast<int>(a)); }
  static Int add(Int a, Int b) { return _mm256_add_epi32(a, b); }
  static Int sub(Int a, Int b) { return _mm256_sub_epi32(a, b); }
  static Int mul(Int a, Int b) { return _mm256_mullo_epi32(a, b); }
  static Int low_half(Int a) { return _mm256_and_si256(a, _mm256_set1_epi32(0xFFFF)); }
  static Int high_half(Int a) { return _mm256_srli_epi32(a, 16); }
  static Float to_float(Int a) { return _mm256_cvtepi32_ps(a); }
  static Int to_int(Float a) { return _mm256_cvttps_epi32(a); }
  static Int pair_at(const std::uint16_t* from, Int index) {
    return _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), index, 2);
  }
};

#endif

}  // namespace vo::kernels
