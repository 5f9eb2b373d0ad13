#pragma once

#include <cstddef>
#include <span>

namespace place {

/// The least cost of a row, at its first occurrence; without a finite one, `reference` is the row's size and
/// the cost infinite.
struct RowMinimum {
  std::size_t reference = 0;
  float cost = 0;
};
RowMinimum row_minimum(std::span<const float> row);

/// The least cost further than `window` from `from`; infinite if there is none.
float minimum_outside(std::span<const float> row, std::size_t from, std::size_t window);

}  // namespace place
