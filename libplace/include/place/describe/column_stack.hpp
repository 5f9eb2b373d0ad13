#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <vo/image/image_stack.hpp>

namespace place {

/// Descriptors of columns: vertical strips of a picture, so that a camera turned a little sees the same
/// columns shifted. Stored one after another, column by column, with `channels` values of -127 to 127 in a
/// column.
struct ColumnStack {
  int columns = 0;
  int channels = 0;
  std::vector<std::int8_t, vo::CacheAligned<std::int8_t>> values;

  [[nodiscard]] std::size_t descriptor_size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(channels);
  }
  [[nodiscard]] std::size_t size() const {
    return descriptor_size() == 0 ? 0 : values.size() / descriptor_size();
  }
  [[nodiscard]] std::span<const std::int8_t> operator[](std::size_t i) const {
    return std::span(values).subspan(i * descriptor_size(), descriptor_size());
  }
  [[nodiscard]] std::span<std::int8_t> operator[](std::size_t i) {
    return std::span(values).subspan(i * descriptor_size(), descriptor_size());
  }
};

}  // namespace place
