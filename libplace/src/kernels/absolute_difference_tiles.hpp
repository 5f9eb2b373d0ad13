#pragma once

#include "kernels/absolute_difference.hpp"

#include <algorithm>

/// The sums of absolute differences, written once over any kind of lanes: tiles of a few queries by a few
/// references whose sums stay in registers. `Lanes` has
///   Bytes, Sums                     register types
///   kBytes                          bytes of a Bytes
///   kTileQueries, kTileReferences   as many sums as there are registers for
///   load(from), load_last(end, n)   kBytes bytes; the n bytes before `end` with zeros for the rest
///   keep_in_register(bytes)         else GCC reads them from memory again for each use, at half the speed
///   zero(), add(sums, a, b), total(sums)
/// Included only by the sources of `kernels`.
namespace place::kernels {

/// Where the images of a tile begin.
struct Tile {
  const std::uint8_t* queries;
  const std::uint8_t* references;
  std::size_t size;
  std::uint32_t* sums;
  std::size_t stride;
};

/// Holds kQueries * kReferences sums, kQueries bytes and two more in registers. Not inlined: within a larger
/// function compilers run out of registers and spill sums.
template <class Lanes, std::size_t kQueries, std::size_t kReferences>
[[gnu::noinline]] void sum_tile(const Tile& tile) {
  typename Lanes::Sums sums[kQueries][kReferences];
  for (auto& row : sums) {
    for (auto& sum : row) sum = Lanes::zero();
  }
  const std::size_t size = tile.size;
  const auto add_all = [&](const auto& load) __attribute__((always_inline)) {
    typename Lanes::Bytes queries[kQueries];
    for (std::size_t i = 0; i < kQueries; ++i) queries[i] = load(tile.queries + i * size);
    for (std::size_t j = 0; j < kReferences; ++j) {
      typename Lanes::Bytes reference = load(tile.references + j * size);
      Lanes::keep_in_register(reference);
      for (std::size_t i = 0; i < kQueries; ++i) sums[i][j] = Lanes::add(sums[i][j], queries[i], reference);
    }
  };
  const std::size_t whole = size - size % Lanes::kBytes;
  for (std::size_t k = 0; k < whole; k += Lanes::kBytes) {
    add_all([k](const std::uint8_t* image) __attribute__((always_inline)) { return Lanes::load(image + k); });
  }
  if (const std::size_t rest = size - whole; rest > 0) {
    add_all([ size, rest ](const std::uint8_t* image)
                __attribute__((always_inline)) { return Lanes::load_last(image + size, rest); });
  }
  for (std::size_t i = 0; i < kQueries; ++i) {
    for (std::size_t j = 0; j < kReferences; ++j) tile.sums[i * tile.stride + j] = Lanes::total(sums[i][j]);
  }
}

/// Tiles over all queries for kReferences references, which stay in the first-level cache meanwhile, while
/// the next ones are fetched.
template <class Lanes, std::size_t kReferences>
inline void sum_column(Tile tile, std::size_t queries) {
  constexpr std::size_t kLine = 64;
  const std::size_t bytes = kReferences * tile.size;
  const std::size_t share = bytes * Lanes::kTileQueries / queries + kLine;
  std::size_t fetched = 0;
  const auto take = [&]<std::size_t kQueries>() {
    for (const std::size_t end = std::min(bytes, fetched + share); fetched < end; fetched += kLine)
      __builtin_prefetch(tile.references + bytes + fetched, 0, 2);
    sum_tile<Lanes, kQueries, kReferences>(tile);
    tile.queries += kQueries * tile.size;
    tile.sums += kQueries * tile.stride;
    queries -= kQueries;
  };
  while (queries >= Lanes::kTileQueries) take.template operator()<Lanes::kTileQueries>();
  while (queries > 0) take.template operator()<1>();
}

template <class Lanes>
inline void sum_all(ByteImages queries, ByteImages references, std::size_t size, std::uint32_t* sums,
                    std::size_t stride) {
  if (queries.count == 0) return;
  if (size < Lanes::kBytes) return absolute_difference_scalar(queries, references, size, sums, stride);
  constexpr std::size_t kReferences = Lanes::kTileReferences;
  std::size_t j = 0;
  const auto column = [&] {
    return Tile{queries.bytes, references.bytes + j * size, size, sums + j, stride};
  };
  for (; j + kReferences <= references.count; j += kReferences)
    sum_column<Lanes, kReferences>(column(), queries.count);
  for (; j < references.count; ++j) sum_column<Lanes, 1>(column(), queries.count);
}

}  // namespace place::kernels
