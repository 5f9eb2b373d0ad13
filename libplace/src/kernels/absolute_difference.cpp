#include "kernels/absolute_difference.hpp"

namespace place::kernels {

void absolute_difference_scalar(const std::uint8_t* query, const std::uint8_t* references, std::size_t count,
                                std::size_t size, std::uint32_t* sums) {
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint8_t* reference = references + j * size;
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < size; ++k) {
      sum += query[k] > reference[k] ? query[k] - reference[k] : reference[k] - query[k];
    }
    sums[j] = sum;
  }
}

AbsoluteDifferenceKernel absolute_difference() {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (has_avx2) return absolute_difference_avx2;
#endif
  return absolute_difference_scalar;
}

}  // namespace place::kernels
