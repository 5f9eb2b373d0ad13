#include "kernels/float_sums.hpp"

#include "kernels/float_sums_tiles.hpp"
#include "lanes/plain.hpp"

namespace place::kernels {

const FloatKernels& scalar_float_kernels() {
  return kFloatTable<vo::lanes::Scalar, 1, 1>;
}

const FloatKernels& float_kernels() {
#if defined(__x86_64__)
  static const FloatKernels& fastest = []() -> const FloatKernels& {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
      return avx512_float_kernels();
    return __builtin_cpu_supports("avx2") ? avx2_float_kernels() : scalar_float_kernels();
  }();
  return fastest;
#elif defined(__aarch64__)
  return neon_float_kernels();
#else
  return scalar_float_kernels();
#endif
}

}  // namespace place::kernels
