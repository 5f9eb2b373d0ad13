#include "kernels/interleave.hpp"

#include <algorithm>

namespace place::kernels {

void interleave(const FloatRowsView& rows, const RowBlock& block, std::size_t lanes, float* to) {
  constexpr std::size_t kTogether = 16;  // values of a row, a cache line, read before the next row
  for (std::size_t k = 0; k < block.values; k += kTogether) {
    const std::size_t past = std::min(k + kTogether, block.values);
    std::fill(to + k * lanes, to + past * lanes, 0.0F);
    for (std::size_t i = 0; i < block.count; ++i) {
      const float* const row = rows[block.first + i].data() + block.from;
      for (std::size_t at = k; at < past; ++at) to[at * lanes + i] = row[at];
    }
  }
}

void interleave_columns(const FloatRowsView& matrix, const RowBlock& block, std::size_t lanes, float* to) {
  for (std::size_t k = 0; k < block.values; ++k, to += lanes) {
    const float* const values = matrix[block.from + k].data() + block.first;
    std::fill(std::copy_n(values, block.count, to), to + lanes, 0.0F);
  }
}

}  // namespace place::kernels
