#pragma once

#include <cstddef>

/// Sums over pairs of rows of floats. The terms of a pair are added one after the other in the order of the
/// values, each step rounded to float; registers hold the sums of different references. So all instruction
/// sets give the same bits.
///
/// Both sides are interleaved: value k of all queries of a tile, or of all references of a panel, lie side
/// by side.
namespace place::kernels {

enum class Term { kProduct, kAbsoluteDifference, kSquaredDifference };

/// A tile of sums: a few queries by a few references.
struct FloatTile {
  const float* queries;     ///< [value][query]
  const float* references;  ///< [value][reference]
  std::size_t size;         ///< values of a row
  float* sums;              ///< [query][reference]
};

/// From sums to costs, for the references of a panel. With `reference_scales` the cost is 1 - (sum *
/// reference_scale) * query_scale, at least 0; otherwise the sum, or its square root, times query_scale.
struct FloatCostRow {
  const float* sums;              ///< of each reference
  const float* reference_scales;  ///< of each reference, or null
  float query_scale;
  bool root;
  float units;   ///< costs are rounded to whole multiples of 1 / units, a power of two
  float* costs;  ///< of each reference
};

struct FloatKernels {
  std::size_t queries;     ///< of a tile
  std::size_t references;  ///< of a panel
  void (*add)(Term, const FloatTile&);
  void (*costs)(const FloatCostRow&);
};

/// The plain loops that the others must equal.
const FloatKernels& scalar_float_kernels();

#if defined(__x86_64__)
/// Needs AVX2.
const FloatKernels& avx2_float_kernels();
/// Needs AVX-512 F and BW.
const FloatKernels& avx512_float_kernels();
#elif defined(__aarch64__)
const FloatKernels& neon_float_kernels();
#endif

/// The fastest that this processor supports.
const FloatKernels& float_kernels();

}  // namespace place::kernels
