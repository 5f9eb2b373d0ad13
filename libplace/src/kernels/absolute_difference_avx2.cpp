#include "kernels/absolute_difference_tiles.hpp"

#if defined(__x86_64__)

#include "lanes/avx2.hpp"

namespace place::kernels {
namespace {

struct Tiles : vo::lanes::Avx2 {
  static constexpr std::size_t kTileQueries = 6, kTileReferences = 2;  // all 16 registers

  template <std::size_t kQueries, std::size_t kReferences>
  static void store_tile(const Sums (&sums)[kQueries][kReferences], const ScaledSums& to) {
    store_each<Tiles>(sums, to);
  }
};

}  // namespace

void absolute_difference_avx2(ByteImages queries, ByteImages references, ImageSize size,
                              const ScaledSums& sums) {
  sum_all<Tiles>(queries, references, size, sums);
}

}  // namespace place::kernels

#endif
