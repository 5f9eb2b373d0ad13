#include "kernels/absolute_difference.hpp"

#if defined(__x86_64__)

#include <immintrin.h>

namespace place::kernels {
namespace {

constexpr std::size_t kLane = 32;

__attribute__((target("avx2"))) std::uint32_t horizontal_sum(__m256i sums) {
  const __m128i halves = _mm_add_epi64(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
  return static_cast<std::uint32_t>(_mm_cvtsi128_si64(halves) + _mm_extract_epi64(halves, 1));
}

}  // namespace

__attribute__((target("avx2"))) void absolute_difference_avx2(const std::uint8_t* query,
                                                              const std::uint8_t* references,
                                                              std::size_t count, std::size_t size,
                                                              std::uint32_t* sums) {
  const std::size_t whole = size - size % kLane;
  std::size_t j = 0;
  // Four references share each load of the query.
  for (; j + 4 <= count; j += 4) {
    const std::uint8_t* reference = references + j * size;
    __m256i sum[4] = {_mm256_setzero_si256(), _mm256_setzero_si256(), _mm256_setzero_si256(),
                      _mm256_setzero_si256()};
    for (std::size_t k = 0; k < whole; k += kLane) {
      const __m256i q = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(query + k));
      for (std::size_t i = 0; i < 4; ++i) {
        const __m256i r = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(reference + i * size + k));
        sum[i] = _mm256_add_epi64(sum[i], _mm256_sad_epu8(q, r));
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      std::uint32_t tail = 0;
      absolute_difference_scalar(query + whole, reference + i * size + whole, 1, size - whole, &tail);
      sums[j + i] = horizontal_sum(sum[i]) + tail;
    }
  }
  absolute_difference_scalar(query, references + j * size, count - j, size, sums + j);
}

}  // namespace place::kernels

#endif
