#pragma once

#include "place/describe/descriptor.hpp"
#include "place/describe/float_rows.hpp"

#include <cstdint>
#include <span>

namespace place {

/// Writes tables of floats as half-precision numbers (IEEE 754 binary16, little-endian), which is precise
/// enough for PCA axes and words and takes half the space in a route.
class LearnedWriter {
 public:
  void add(const FloatRows& rows);
  /// The same in half the space: each row in 127 steps to either side up to its largest value.
  void add_coarsely(const FloatRows& rows);
  [[nodiscard]] Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Reads what `LearnedWriter` wrote, in the same order. Throws `vo::Error` at the end of the bytes.
class LearnedReader {
 public:
  explicit LearnedReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
  FloatRows next();
  FloatRows next_coarse();

 private:
  /// Space for rows of values of this many bytes, if that many are left.
  FloatRows rows_of(std::size_t width, std::size_t count, std::size_t bytes);

  std::span<const std::uint8_t> rest_;
};

}  // namespace place
