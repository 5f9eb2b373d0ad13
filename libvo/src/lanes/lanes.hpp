#pragma once

#include <cstddef>
#include <utility>

/// The one layer under every kernel of both libraries: several numbers at a time, once for each instruction
/// set. A kernel is a template over a kind of lanes, so it is written once, does the same operations in the
/// same order everywhere, and gives the same bits; `Scalar` is the plain twin that the others are tested
/// against.
///
/// A kernel is instantiated once for each kind, in a source of its own, compiled for that instruction set and
/// with -ffp-contract=off; a table of function pointers is chosen when the program first asks for it. Those
/// sources must not instantiate anything that others share: a linker that kept their copy would take the
/// instruction set to processors without it.
///
/// Kinds of lanes (scalar.hpp, avx2.hpp, avx512.hpp, neon.hpp) have, as far as kernels ask for it there:
///   kCount                        numbers of a register
///   Float, Int                    registers of floats and of 32-bit integers that wrap around
///   load, store, all_float, all_int, add, sub, mul, div, min, max, abs, sqrt ...
///   Products                      of small integers, see `Packing`
namespace vo::lanes {

/// How small integers lie in memory for dot products: `kGroup` of them, one after the other, in each 32 bits
/// of a register, as signed bytes (4) or as 16 bits (2).
struct Packing {
  std::size_t group;  ///< values in 32 bits
  int left_offset;    ///< added to every value of the left operand, which some instructions want >= 0
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
