#include "kernels/absolute_difference_tiles.hpp"

#if defined(__x86_64__)

#include "lanes/avx512.hpp"

namespace place::kernels {
namespace {

struct Tiles : vo::lanes::Avx512 {
  static constexpr std::size_t kTileQueries = 6, kTileReferences = 4;  // 30 of 32 registers

  /// The totals of a whole tile are added up together, a row of references at a time.
  template <std::size_t kQueries, std::size_t kReferences>
  static void store_tile(const Sums (&sums)[kQueries][kReferences], const ScaledSums& to) {
    if constexpr (kQueries == 6 && kReferences == 4) {
      const Sums last = add_parts(interleaved(sums[4]), interleaved(sums[5]));
      const Sums first = add_parts(add_parts(interleaved(sums[0]), interleaved(sums[1])),
                                   add_parts(interleaved(sums[2]), interleaved(sums[3])));
      store_rows<4>(first, to.values, to);
      store_rows<2>(add_parts(last, last), to.values + 4 * to.stride, to);
    } else {
      store_each<Tiles>(sums, to);
    }
  }

 private:
  /// Scaled 128-bit parts, one to each row.
  template <std::size_t kRows>
  static void store_rows(Sums totals, float* row, const ScaledSums& to) {
    const __m512 scaled = _mm512_mul_ps(_mm512_cvtepi32_ps(totals), _mm512_set1_ps(to.scale));
    _mm_storeu_ps(row, _mm512_castps512_ps128(scaled));
    _mm_storeu_ps(row + to.stride, _mm512_extractf32x4_ps(scaled, 1));
    if constexpr (kRows == 2) return;
    _mm_storeu_ps(row + 2 * to.stride, _mm512_extractf32x4_ps(scaled, 2));
    _mm_storeu_ps(row + 3 * to.stride, _mm512_extractf32x4_ps(scaled, 3));
  }
  /// From four registers whose 64-bit parts are below 2^32: four parts of 128 bits, each with a 32-bit sum
  /// for every register, which add up to the totals.
  static Sums interleaved(const Sums (&sums)[4]) {
    const Sums first = _mm512_add_epi32(sums[0], _mm512_slli_epi64(sums[1], 32));
    const Sums second = _mm512_add_epi32(sums[2], _mm512_slli_epi64(sums[3], 32));
    return _mm512_add_epi32(_mm512_unpacklo_epi64(first, second), _mm512_unpackhi_epi64(first, second));
  }
  /// Neighbouring parts of 128 bits added: two of `a`, then two of `b`.
  static Sums add_parts(Sums a, Sums b) {
    return _mm512_add_epi32(_mm512_shuffle_i64x2(a, b, 0x88), _mm512_shuffle_i64x2(a, b, 0xdd));
  }
};

}  // namespace

void absolute_difference_avx512(ByteImages queries, ByteImages references, ImageSize size,
                                const ScaledSums& sums) {
  sum_all<Tiles>(queries, references, size, sums);
}

}  // namespace place::kernels

#endif
