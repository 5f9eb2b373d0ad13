#include "kernels/absolute_difference_tiles.hpp"

#if defined(__x86_64__)

#include <immintrin.h>
#include <iterator>
#include <numeric>

namespace place::kernels {
namespace {

struct Avx512 {
  using Bytes = __m512i;
  using Sums = __m512i;  // eight of 64 bits
  static constexpr std::size_t kBytes = 64;
  static constexpr std::size_t kTileQueries = 4, kTileReferences = 6;  // 30 of 32 registers

  static Bytes load(const std::uint8_t* from) { return _mm512_loadu_si512(from); }
  static Bytes load_last(const std::uint8_t* end, std::size_t count) {
    return _mm512_maskz_loadu_epi8((__mmask64{1} << count) - 1, end - count);
  }
  static void keep_in_register(Bytes& bytes) { asm("" : "+v"(bytes)); }
  static Sums zero() { return _mm512_setzero_si512(); }
  static Sums add(Sums sums, Bytes a, Bytes b) { return _mm512_add_epi64(sums, _mm512_sad_epu8(a, b)); }
  static std::uint32_t total(Sums sums) {
    alignas(kBytes) std::uint64_t all[kBytes / sizeof(std::uint64_t)];
    _mm512_store_si512(all, sums);
    return static_cast<std::uint32_t>(std::accumulate(std::begin(all), std::end(all), std::uint64_t{0}));
  }
};

}  // namespace

void absolute_difference_avx512(ByteImages queries, ByteImages references, std::size_t size,
                                std::uint32_t* sums, std::size_t stride) {
  sum_all<Avx512>(queries, references, size, sums, stride);
}

}  // namespace place::kernels

#endif
