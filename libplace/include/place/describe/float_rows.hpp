#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// Rows that are only looked at, where they are: `FloatRows`, or other memory of that form.
struct FloatRowsView {
  std::size_t width = 0;
  std::span<const float> values;

  [[nodiscard]] std::size_t size() const { return width == 0 ? 0 : values.size() / width; }
  [[nodiscard]] std::span<const float> operator[](std::size_t i) const {
    return values.subspan(i * width, width);
  }
};

/// Vectors of one length, one after another in memory.
struct FloatRows {
  std::size_t width = 0;
  std::vector<float> values;

  [[nodiscard]] std::size_t size() const { return width == 0 ? 0 : values.size() / width; }
  [[nodiscard]] std::span<const float> operator[](std::size_t i) const {
    return std::span(values).subspan(i * width, width);
  }
  [[nodiscard]] std::span<float> operator[](std::size_t i) {
    return std::span(values).subspan(i * width, width);
  }
  operator FloatRowsView() const { return {width, values}; }
};

/// `count` rows of zeros.
inline FloatRows make_float_rows(std::size_t width, std::size_t count) {
  return {.width = width, .values = std::vector<float>(width * count)};
}

}  // namespace place
