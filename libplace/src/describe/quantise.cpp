#include "place/describe/quantise.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace place {

float quantisation_step(std::span<const float> values) {
  double squares = 0;
  for (const float value : values) squares += static_cast<double>(value) * value;
  if (!(squares > 0)) return 1;
  return static_cast<float>(4 * std::sqrt(squares / static_cast<double>(values.size())) / kLargestByte);
}

void quantise(std::span<const float> row, float step, ColumnStack& stack, std::size_t i) {
  if (row.size() != stack.descriptor_size() || !(step > 0))
    throw std::invalid_argument("quantise: a row of the stack's size and a step above 0 expected");
  constexpr auto kLargest = static_cast<float>(kLargestByte);
  std::ranges::transform(row, stack[i].begin(), [&](float value) {
    return static_cast<std::int8_t>(std::lround(std::clamp(value / step, -kLargest, kLargest)));
  });
}

ColumnStack make_column_stack(int columns, int channels, std::size_t count) {
  if (columns < 0 || channels < 0) throw std::invalid_argument("make_column_stack: negative size");
  ColumnStack stack{.columns = columns, .channels = channels, .values = {}};
  stack.values.resize(stack.descriptor_size() * count);
  return stack;
}

}  // namespace place
