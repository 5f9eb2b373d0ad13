#pragma once

#include "place/describe/float_rows.hpp"

#include <cstddef>

namespace place::kernels {

/// A stretch of some rows of a matrix.
struct RowBlock {
  std::size_t first, count;          ///< rows
  std::size_t from = 0, values = 0;  ///< of each of them
};

/// Writes the values of `block.count` rows side by side, value by value, in groups of `lanes`, which zeros
/// fill: to[k * lanes + i] is value `from + k` of row `first + i`.
void interleave(const FloatRowsView& rows, const RowBlock& block, std::size_t lanes, float* to);

/// The same of the columns of the matrix: to[k * lanes + i] is value `first + i` of row `from + k`.
void interleave_columns(const FloatRowsView& matrix, const RowBlock& block, std::size_t lanes, float* to);

}  // namespace place::kernels
