#pragma once

#include "kernels/absolute_difference.hpp"
#include "lanes/lanes.hpp"

#include <algorithm>

/// The sums of absolute differences, written once for any kind of lanes: tiles of a few queries by a few
/// references whose sums stay in registers. Included only by the sources of `kernels`.
///
/// `Lanes` is a kind that also has:
///   kTileQueries, kTileReferences  for about as many sums as there are registers
///   store_tile(sums, to)           a tile's totals, of Sums[queries][references], scaled
namespace place::kernels {

using vo::lanes::kLine;
using vo::lanes::unrolled;

/// Pointers to the images of a tile.
struct Tile {
  const std::uint8_t* queries;
  const std::uint8_t* references;
  ImageSize size;
  ScaledSums sums;
  const std::uint8_t* ahead;  ///< 2 * size.bytes to prefetch into the first-level cache
};

/// The totals one by one.
template <class Lanes, std::size_t kQueries, std::size_t kReferences>
[[gnu::always_inline]] inline void store_each(const typename Lanes::Sums (&sums)[kQueries][kReferences],
                                              const ScaledSums& to) {
  unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
    unrolled<kReferences>([&](std::size_t j) __attribute__((always_inline)) {
      to.values[i * to.stride + j] = static_cast<float>(Lanes::total(sums[i][j])) * to.scale;
    });
  });
}

/// Holds kQueries * kReferences sums, kReferences bytes and two more in registers. Not inlined: in a larger
/// function compilers run out of registers and spill sums.
template <class Lanes, std::size_t kQueries, std::size_t kReferences>
[[gnu::noinline]] void sum_tile(const Tile& tile) {
  typename Lanes::Sums sums[kQueries][kReferences];
  unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
    unrolled<kReferences>([&](std::size_t j)
                              __attribute__((always_inline)) { sums[i][j] = Lanes::no_sums(); });
  });
  const std::size_t size = tile.size.bytes, stride = tile.size.stride;
  const auto add_all = [&](const auto& load) __attribute__((always_inline)) {
    typename Lanes::Bytes references[kReferences];
    unrolled<kReferences>([&](std::size_t j) __attribute__((always_inline)) {
      references[j] = load(tile.references + j * stride);
    });
    unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
      typename Lanes::Bytes query = load(tile.queries + i * stride);
      Lanes::keep_in_register(query);
      unrolled<kReferences>([&](std::size_t j) __attribute__((always_inline)) {
        sums[i][j] = Lanes::add_differences(sums[i][j], references[j], query);
      });
    });
  };
  const std::size_t whole = size - size % Lanes::kBytes;
  for (std::size_t k = 0; k < whole; k += Lanes::kBytes) {
    for (std::size_t line = 0; line < 2 * Lanes::kBytes; line += kLine)
      __builtin_prefetch(tile.ahead + 2 * k + line, 0, 3);
    add_all([k](const std::uint8_t* image)
                __attribute__((always_inline)) { return Lanes::load_bytes(image + k); });
  }
  // Otherwise GCC keeps a copy of every sum in memory for the code below.
  unrolled<kQueries>([&](std::size_t i) __attribute__((always_inline)) {
    unrolled<kReferences>([&](std::size_t j)
                              __attribute__((always_inline)) { Lanes::keep_in_register(sums[i][j]); });
  });
  if (const std::size_t rest = size - whole; rest > 0) {
    add_all([ size, rest ](const std::uint8_t* image)
                __attribute__((always_inline)) { return Lanes::load_last(image + size, rest); });
  }
  Lanes::store_tile(sums, tile.sums);
}

/// Tiles over all queries for `columns` times kReferences references, which stay in the first-level cache.
/// The next queries are prefetched into it, and the next references into the second-level cache.
template <class Lanes, std::size_t kReferences>
inline void sum_panel(Tile panel, std::size_t queries, std::size_t columns) {
  const std::size_t stride = panel.size.stride, bytes = columns * kReferences * stride;
  const std::uint8_t* next_references = panel.references + bytes;
  const std::size_t share = bytes * Lanes::kTileQueries / queries + kLine;
  std::size_t fetched = 0;
  const auto take = [&]<std::size_t kQueries>(std::size_t query) {
    for (const std::size_t end = std::min(bytes, fetched + share); fetched < end; fetched += kLine)
      __builtin_prefetch(next_references + fetched, 0, 2);
    Tile tile = panel;
    tile.queries += query * stride;
    tile.sums.values += query * panel.sums.stride;
    const std::uint8_t* next_queries = tile.queries + kQueries * stride;
    for (std::size_t column = 0; column < columns; ++column) {
      tile.ahead = 2 * column < kQueries ? next_queries + 2 * column * stride : tile.queries;
      sum_tile<Lanes, kQueries, kReferences>(tile);
      tile.references += kReferences * stride;
      tile.sums.values += kReferences;
    }
  };
  constexpr std::size_t kQueries = Lanes::kTileQueries;
  if (queries < kQueries) {
    for (std::size_t query = 0; query < queries; ++query) take.template operator()<1>(query);
    return;
  }
  // The last tile may repeat some queries.
  for (std::size_t query = 0; query < queries; query += kQueries)
    take.template operator()<kQueries>(std::min(query, queries - kQueries));
}

template <class Lanes>
inline void sum_all(ByteImages queries, ByteImages references, ImageSize size, const ScaledSums& sums) {
  if (queries.count == 0) return;
  if (size.bytes < Lanes::kBytes) return absolute_difference_scalar(queries, references, size, sums);
  constexpr std::size_t kPanelBytes = 1U << 14U;  // next to two tiles' queries in 32 kB or more
  constexpr std::size_t kReferences = Lanes::kTileReferences;
  const std::size_t most = std::max<std::size_t>(1, kPanelBytes / (kReferences * size.bytes));
  std::size_t j = 0;
  const auto panel = [&] {
    return Tile{queries.bytes,
                references.bytes + j * size.stride,
                size,
                {sums.scale, sums.values + j, sums.stride},
                queries.bytes};
  };
  while (j + kReferences <= references.count) {
    const std::size_t columns = std::min(most, (references.count - j) / kReferences);
    sum_panel<Lanes, kReferences>(panel(), queries.count, columns);
    j += columns * kReferences;
  }
  if (j < references.count) sum_panel<Lanes, 1>(panel(), queries.count, references.count - j);
}

}  // namespace place::kernels
