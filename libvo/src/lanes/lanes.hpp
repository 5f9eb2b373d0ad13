#pragma once

#include <cstddef>
#include <utility>

/// The one layer under every kernel of both libraries: several numbers at a time, once for each instruction
/// set. A kernel is a template over a kind of lanes, so it is written once, does the same operations in the
/// same order everywhere, and gives the same bits; the plain kind is the twin that the others are tested
/// against.
///
/// A kernel is instantiated once for each kind, in a source of its own that is compiled for that instruction
/// set and with -ffp-contract=off, so that no product and sum becomes one rounding. Which is called is chosen
/// once, at run time. Such a source must not instantiate anything that other sources share: a linker that
/// kept its copy would take the instruction set to processors without it.
///
/// A kind of lanes (plain.hpp, avx2.hpp, avx512.hpp, neon.hpp) has what kernels ask of it there:
///   kCount                     numbers of a register
///   Float                      a register of floats: load, store, all, add, sub, mul, div, min, max, abs,
///                              sqrt; where_positive(sign, a), infinite_unless(sign, a): `a` where `sign` has
///                              no sign bit, else 0, infinity; greater, greater_equal: a bit for each lane;
///                              sum of 8: ((0 + 4) + (2 + 6)) + ((1 + 5) + (3 + 7)); least
///   Int                        32 bits that wrap around: load, store, all, add, sub, mul; of signed ones
///                              min, half (towards minus infinity), to_float; to_int (towards zero),
///                              to_nearest (of two the even); low_half, high_half: 16 bits; pair_at(from,
///                              index): from[index] in the low half, from[index + 1] in the high
///   Products                   small integers packed by kPacking, see `Packing`; all_products(from): the 32
///                              bits there, in every lane; add_products(sums, left, right): Int sums + the
///                              dot product of the values in each 32 bits
///   Bytes, kBytes, Sums        for sums of absolute differences: load_bytes, load_last(end, n): the n bytes
///                              before `end`, zeros for the rest; no_sums, add_differences, total (< 2^31)
namespace vo::lanes {

inline constexpr float kInfinity = __builtin_inff();
inline constexpr std::size_t kLine = 64;  ///< bytes of a cache line

/// How small integers lie in memory for dot products: `group` of them, one after the other, in each 32 bits
/// of a register, as signed bytes (4) or as 16 bits (2).
struct Packing {
  std::size_t group;
  int left_offset;  ///< added to every value of the left operand, which some instructions want >= 0
};

/// body(0), body(1) ... body(kCount - 1) one after the other: of arrays that are indexed so, every element
/// gets a register, where a loop leaves them in memory.
template <std::size_t kCount, class Body>
[[gnu::always_inline]] inline void unrolled(const Body& body) {
  [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) __attribute__((always_inline)) {
    (body(kIndex), ...);
  }
  (std::make_index_sequence<kCount>());
}

}  // namespace vo::lanes
