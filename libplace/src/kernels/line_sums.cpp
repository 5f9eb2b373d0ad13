#include "kernels/line_sums_table.hpp"
#include "lanes/plain.hpp"

namespace place::kernels {
const LineKernels& scalar_line_kernels() {
  return kLineTable<vo::lanes::Scalar>;
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
