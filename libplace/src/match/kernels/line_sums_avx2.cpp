#include "match/kernels/line_sums_table.hpp"

#if defined(__x86_64__)

#include <immintrin.h>

namespace place::kernels {
namespace {

struct Avx2 {
  static constexpr std::size_t kCount = 8;
  using Int = __m256i;
  using Float = __m256;

  static Int load(const std::uint32_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static Float load(const float* from) { return _mm256_loadu_ps(from); }
  static void store(std::uint32_t* to, Int a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a); }
  static void store(float* to, Float a) { _mm256_storeu_ps(to, a); }
  static Int all_int(std::int32_t a) { return _mm256_set1_epi32(a); }
  static Float all_float(float a) { return _mm256_set1_ps(a); }
  static Int add(Int a, Int b) { return _mm256_add_epi32(a, b); }
  static Int sub(Int a, Int b) { return _mm256_sub_epi32(a, b); }
  static Int min(Int a, Int b) { return _mm256_min_epi32(a, b); }
  static Float add(Float a, Float b) { return _mm256_add_ps(a, b); }
  static Float mul(Float a, Float b) { return _mm256_mul_ps(a, b); }
  static Float min(Float a, Float b) { return _mm256_min_ps(a, b); }
  static Float to_float(Int a) { return _mm256_cvtepi32_ps(a); }
  static Int rounded(Float a, float centre, float scale) {
    return _mm256_cvtps_epi32(_mm256_mul_ps(_mm256_sub_ps(a, all_float(centre)), all_float(scale)));
  }
  static float least(Float a) {
    __m128 four = _mm_min_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    four = _mm_min_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_min_ss(four, _mm_movehdup_ps(four)));
  }
};

}  // namespace

const LineKernels& avx2_line_kernels() {
  return kLineTable<Avx2>;
}

}  // namespace place::kernels

#endif
