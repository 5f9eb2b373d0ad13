#include "match/kernels/line_sums_table.hpp"

#include <algorithm>
#include <cmath>

namespace place::kernels {
namespace {

/// One number at a time.
struct Scalar {
  static constexpr std::size_t kCount = 1;
  using Int = std::uint32_t;
  using Float = float;

  static Int load(const std::uint32_t* from) { return *from; }
  static Float load(const float* from) { return *from; }
  static void store(std::uint32_t* to, Int a) { *to = a; }
  static void store(float* to, Float a) { *to = a; }
  static Int all_int(std::int32_t a) { return static_cast<Int>(a); }
  static Float all_float(float a) { return a; }
  static Int add(Int a, Int b) { return a + b; }
  static Int sub(Int a, Int b) { return a - b; }
  static Int min(Int a, Int b) {
    return static_cast<Int>(std::min(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)));
  }
  static Float add(Float a, Float b) { return a + b; }
  static Float mul(Float a, Float b) { return a * b; }
  static Float min(Float a, Float b) { return a < b ? a : b; }
  static Float to_float(Int a) { return static_cast<float>(static_cast<std::int32_t>(a)); }
  static Int rounded(Float a, float centre, float scale) {
    return static_cast<Int>(static_cast<std::int32_t>(std::lrint((a - centre) * scale)));
  }
  static float least(Float a) { return a; }
};

}  // namespace

const LineKernels& scalar_line_kernels() {
  return kLineTable<Scalar>;
}

const LineKernels& line_kernels() {
#if defined(__x86_64__)
  static const LineKernels& fastest = []() -> const LineKernels& {
    if (__builtin_cpu_supports("avx512f")) return avx512_line_kernels();
    return __builtin_cpu_supports("avx2") ? avx2_line_kernels() : scalar_line_kernels();
  }();
  return fastest;
#else
  return scalar_line_kernels();
#endif
}

}  // namespace place::kernels
