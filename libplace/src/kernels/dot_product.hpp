#pragma once

#include "lanes/lanes.hpp"

#include <cstddef>
#include <cstdint>

/// Dot products of signed bytes as 32-bit integers, and the costs computed from them. Exact while a sum fits
/// 31 bits, so every instruction set gives the same integers.
///
/// Both sides are packed: the queries of a tile, or the references of a panel, interleaved a few values at a
/// time. A register then holds sums of as many references as it has lanes, and nothing is ever added across
/// a register.
namespace place::kernels {

/// Rows of signed bytes, one after another; never -128.
struct SignedRows {
  const std::int8_t* values;
  std::size_t count;
  std::size_t size;  ///< of a row; a multiple of 4
};

/// A tile of sums: a few queries by a few references, over a stretch of their values.
struct DotTile {
  const std::uint8_t* queries;     ///< packed, from the stretch's first value on
  const std::uint8_t* references;  ///< the same
  std::size_t size;                ///< of the stretch; a multiple of 4
  const std::int32_t* start;       ///< initial sum of each reference
  std::int32_t* sums;              ///< [query][reference]
};

/// From a query's sums for every shift to its least cost over the shifts, for the references of a panel. The
/// cost of a shift is 1 - (sum * reference_scale) * query_scale.
struct ShiftCosts {
  const std::int32_t* sums;  ///< [shift][reference], `stride` from one shift to the next
  std::size_t stride;
  std::size_t shifts;
  const float* query_scales;      ///< [shift]
  const float* reference_scales;  ///< [shift][reference]
  float* costs;                   ///< of each reference, whole multiples of 1 / kCostUnits
};
inline constexpr float kCostUnits = 1 << 15U;

struct DotKernels {
  std::size_t queries;     ///< of a tile
  std::size_t references;  ///< of a panel
  vo::lanes::Packing packing;
  void (*multiply)(const DotTile&);
  void (*costs)(const ShiftCosts&);
  /// The same from the ten sums of `match/shift_plan.hpp` instead of the sums of five shifts.
  void (*costs_of_five)(const ShiftCosts&);
};

/// Bytes of a packed tile or panel of `lanes` rows. Value k of all of them begins at byte packed_bytes(k).
constexpr std::size_t packed_bytes(const vo::lanes::Packing& packing, std::size_t lanes, std::size_t size) {
  return size / packing.group * sizeof(std::uint32_t) * lanes;
}

/// Packs up to `lanes` rows as left operands (queries) or right ones (references), padded with zero rows.
void pack_left(const vo::lanes::Packing& packing, const SignedRows& rows, std::size_t lanes,
               std::uint8_t* packed);
void pack_right(const vo::lanes::Packing& packing, const SignedRows& rows, std::size_t lanes,
                std::uint8_t* packed);

/// The plain loops that the others must equal.
const DotKernels& scalar_dot_kernels();

#if defined(__x86_64__)
/// Needs AVX2.
const DotKernels& avx2_dot_kernels();
/// Needs AVX-512 F and BW.
const DotKernels& avx512_dot_kernels();
/// Needs AVX-512 F, BW and VNNI.
const DotKernels& vnni_dot_kernels();
#elif defined(__aarch64__)
const DotKernels& neon_dot_kernels();
#endif

/// The fastest that this processor supports.
const DotKernels& dot_kernels();

}  // namespace place::kernels
