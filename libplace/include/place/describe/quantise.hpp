#pragma once

#include "place/describe/column_stack.hpp"
#include "place/describe/float_rows.hpp"

#include <span>

namespace place {

/// Values are kept in so many steps to either side of 0. Twice as many would fit a byte and tell nothing
/// more; the products of these are the faster ones (`ShiftedCosine`).
inline constexpr int kLargestByte = 63;

/// The step in which values of this spread are kept as bytes: all steps reach four deviations, beyond which
/// one value in 16,000 lies. `values`: a sample. 1 where they do not differ from 0.
float quantisation_step(std::span<const float> values);

/// A row of floats, columns one after another, as the `i`-th descriptor of a stack: rounded to steps, no
/// further than kLargestByte from 0. Throws `std::invalid_argument` if the sizes differ.
void quantise(std::span<const float> row, float step, ColumnStack& stack, std::size_t i);

/// An empty stack with room for `count` descriptors, all 0.
ColumnStack make_column_stack(int columns, int channels, std::size_t count);

}  // namespace place
