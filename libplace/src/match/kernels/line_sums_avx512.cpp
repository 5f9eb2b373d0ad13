#include "match/kernels/line_sums_table.hpp"

#if defined(__x86_64__)

#include <immintrin.h>

namespace place::kernels {
namespace {

struct Avx512 {
  static constexpr std::size_t kCount = 16;
  using Int = __m512i;
  using Float = __m512;

  static Int load(const std::uint32_t* from) { return _mm512_loadu_si512(from); }
  static Float load(const float* from) { return _mm512_loadu_ps(from); }
  static void store(std::uint32_t* to, Int a) { _mm512_storeu_si512(to, a); }
  static void store(float* to, Float a) { _mm512_storeu_ps(to, a); }
  static Int all_int(std::int32_t a) { return _mm512_set1_epi32(a); }
  static Float all_float(float a) { return _mm512_set1_ps(a); }
  static Int add(Int a, Int b) { return _mm512_add_epi32(a, b); }
  static Int sub(Int a, Int b) { return _mm512_sub_epi32(a, b); }
  static Int min(Int a, Int b) { return _mm512_min_epi32(a, b); }
  static Float add(Float a, Float b) { return _mm512_add_ps(a, b); }
  static Float mul(Float a, Float b) { return _mm512_mul_ps(a, b); }
  static Float min(Float a, Float b) { return _mm512_min_ps(a, b); }
  static Float to_float(Int a) { return _mm512_cvtepi32_ps(a); }
  static Int rounded(Float a, float centre, float scale) {
    return _mm512_cvtps_epi32(_mm512_mul_ps(_mm512_sub_ps(a, all_float(centre)), all_float(scale)));
  }
  static float least(Float a) { return _mm512_reduce_min_ps(a); }
};

}  // namespace

const LineKernels& avx512_line_kernels() {
  return kLineTable<Avx512>;
}

}  // namespace place::kernels

#endif
