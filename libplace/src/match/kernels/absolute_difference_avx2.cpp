#include "match/kernels/absolute_difference_tiles.hpp"

#if defined(__x86_64__)

#include <immintrin.h>

namespace place::kernels {
namespace {

struct Avx2 {
  using Bytes = __m256i;
  using Sums = __m256i;  // four of 64 bits
  static constexpr std::size_t kBytes = 32;
  static constexpr std::size_t kTileQueries = 6, kTileReferences = 2;  // all 16 registers

  static Bytes load(const std::uint8_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static Bytes load_last(const std::uint8_t* end, std::size_t count) {
    const __m256i place = _mm256_setr_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18,
                                           19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31);
    const __m256i before = _mm256_set1_epi8(static_cast<char>(kBytes - count - 1));
    return _mm256_and_si256(load(end - kBytes), _mm256_cmpgt_epi8(place, before));
  }
  static void keep_in_register(Bytes& bytes) { asm("" : "+x"(bytes)); }
  static Sums zero() { return _mm256_setzero_si256(); }
  static Sums add(Sums sums, Bytes a, Bytes b) { return _mm256_add_epi64(sums, _mm256_sad_epu8(a, b)); }
  static std::int32_t total(Sums sums) {
    const __m128i halves = _mm_add_epi64(_mm256_castsi256_si128(sums), _mm256_extracti128_si256(sums, 1));
    return static_cast<std::int32_t>(_mm_cvtsi128_si64(halves) + _mm_extract_epi64(halves, 1));
  }
  template <std::size_t kQueries, std::size_t kReferences>
  static void store(const Sums (&sums)[kQueries][kReferences], const ScaledSums& to) {
    store_each<Avx2>(sums, to);
  }
};

}  // namespace

void absolute_difference_avx2(ByteImages queries, ByteImages references, ImageSize size,
                              const ScaledSums& sums) {
  sum_all<Avx2>(queries, references, size, sums);
}

}  // namespace place::kernels

#endif
