#pragma once

#include "place/describe/column_stack.hpp"
#include "place/describe/float_rows.hpp"

#include <span>

namespace place {

/// Values are kept in this many steps on either side of 0. Twice as many would fit a byte but add no
/// information, and these have faster products (`ShiftedCosine`).
inline constexpr int kLargestByte = 63;

/// The step for keeping values of this spread as bytes: the steps reach four deviations, beyond which lies
/// one value in 16,000. `values`: a sample. 1 if all are 0.
float quantisation_step(std::span<const float> values);

/// A row of floats, columns one after another, as the `i`-th descriptor of a stack: rounded to steps and
/// clamped to +-kLargestByte. Throws `std::invalid_argument` if the sizes differ.
void quantise(std::span<const float> row, float step, ColumnStack& stack, std::size_t i);

/// An empty stack with room for `count` descriptors, all 0.
ColumnStack make_column_stack(int columns, int channels, std::size_t count);

}  // namespace place
