#pragma once

#include "place/describe/descriptor.hpp"
#include "place/describe/float_rows.hpp"

#include <cstdint>
#include <span>

namespace place {

/// Writes tables of floats as half-precision numbers (IEEE 754 binary16, little-endian), which PCA axes and
/// words bear well and which take half the room in a route.
class LearnedWriter {
 public:
  void add(const FloatRows& rows);
  /// The same in half the room: each row in 127 steps to either side up to its largest value.
  void add_coarsely(const FloatRows& rows);
  [[nodiscard]] Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

/// Reads what `LearnedWriter` wrote, in the same order. Throws `vo::Error` where there is no more.
class LearnedReader {
 public:
  explicit LearnedReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
  FloatRows next();
  FloatRows next_coarse();

 private:
  /// Room for rows of values of so many bytes, if there are that many left.
  FloatRows rows_of(std::size_t width, std::size_t count, std::size_t bytes);

  std::span<const std::uint8_t> rest_;
};

}  // namespace place
