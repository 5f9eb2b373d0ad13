#pragma once

#include <cstddef>
#include <cstdint>

#include <place/describe/column_stack.hpp>
#include <vo/base/rng.hpp>

namespace test_support {

/// Descriptors of uniformly random values from -most to most.
inline place::ColumnStack random_columns(int columns, int channels, std::size_t count, int most,
                                         std::uint64_t seed) {
  place::ColumnStack stack{.columns = columns, .channels = channels, .values = {}};
  stack.values.resize(count * stack.descriptor_size());
  vo::Rng rng(seed);
  for (std::int8_t& value : stack.values)
    value = static_cast<std::int8_t>(static_cast<int>(rng.index(2 * static_cast<std::uint64_t>(most) + 1)) -
                                     most);
  return stack;
}

}  // namespace test_support
