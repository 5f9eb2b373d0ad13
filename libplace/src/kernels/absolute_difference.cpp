#include "kernels/absolute_difference.hpp"

namespace place::kernels {

void absolute_difference_scalar(ByteImages queries, ByteImages references, ImageSize size,
                                const ScaledSums& sums) {
  for (std::size_t i = 0; i < queries.count; ++i) {
    const std::uint8_t* query = queries.bytes + i * size.stride;
    for (std::size_t j = 0; j < references.count; ++j) {
      const std::uint8_t* reference = references.bytes + j * size.stride;
      std::int32_t sum = 0;
      for (std::size_t k = 0; k < size.bytes; ++k) {
        sum += query[k] > reference[k] ? query[k] - reference[k] : reference[k] - query[k];
      }
      sums.values[i * sums.stride + j] = static_cast<float>(sum) * sums.scale;
    }
  }
}

AbsoluteDifferenceKernel absolute_difference() {
#if defined(__x86_64__)
  static const AbsoluteDifferenceKernel fastest = [] {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
      return absolute_difference_avx512;
    return __builtin_cpu_supports("avx2") ? absolute_difference_avx2 : absolute_difference_scalar;
  }();
  return fastest;
#elif defined(__aarch64__)
  return absolute_difference_neon;
#else
  return absolute_difference_scalar;
#endif
}

}  // namespace place::kernels
