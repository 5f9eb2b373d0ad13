#include "match/kernels/absolute_difference_tiles.hpp"

#if defined(__aarch64__)

#include <arm_neon.h>

namespace place::kernels {
namespace {

struct Neon {
  using Bytes = uint8x16_t;
  using Sums = uint32x4_t;
  static constexpr std::size_t kBytes = 16;
  static constexpr std::size_t kTileQueries = 6, kTileReferences = 4;  // 30 of 32 registers

  static Bytes load(const std::uint8_t* from) { return vld1q_u8(from); }
  static Bytes load_last(const std::uint8_t* end, std::size_t count) {
    static constexpr std::uint8_t kPlaces[kBytes] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const auto first = static_cast<std::uint8_t>(kBytes - count);
    return vandq_u8(load(end - kBytes), vcgeq_u8(vld1q_u8(kPlaces), vdupq_n_u8(first)));
  }
  template <typename Register>
  static void keep_in_register(Register& values) {
    asm("" : "+w"(values));
  }
  static Sums zero() { return vdupq_n_u32(0); }
  static Sums add(Sums sums, Bytes a, Bytes b) { return vpadalq_u16(sums, vpaddlq_u8(vabdq_u8(a, b))); }
  static std::int32_t total(Sums sums) { return static_cast<std::int32_t>(vaddvq_u32(sums)); }
  template <std::size_t kQueries, std::size_t kReferences>
  static void store(const Sums (&sums)[kQueries][kReferences], const ScaledSums& to) {
    store_each<Neon>(sums, to);
  }
};

}  // namespace

void absolute_difference_neon(ByteImages queries, ByteImages references, ImageSize size,
                              const ScaledSums& sums) {
  sum_all<Neon>(queries, references, size, sums);
}

}  // namespace place::kernels

#endif
