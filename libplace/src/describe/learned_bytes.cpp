#include "describe/learned_bytes.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/core/cvdef.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

constexpr float kCoarsest = 127;

void put(Bytes& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint32_t get(std::span<const std::uint8_t>& rest, std::size_t count) {
  if (rest.size() < count)
    throw vo::Error("what the route learned", "breaks off", "a route that retrace build has written");
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint32_t>(rest[i]) << (8 * i);
  rest = rest.subspan(count);
  return value;
}

}  // namespace

void LearnedWriter::add(const FloatRows& rows) {
  put(bytes_, static_cast<std::uint32_t>(rows.width), 4);
  put(bytes_, static_cast<std::uint32_t>(rows.size()), 4);
  for (const float value : rows.values) put(bytes_, cv::float16_t(value).bits(), 2);
}

void LearnedWriter::add_coarsely(const FloatRows& rows) {
  FloatRows steps = make_float_rows(1, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    float largest = 0;
    for (const float value : rows[i]) largest = std::max(largest, std::abs(value));
    const cv::float16_t step(largest / kCoarsest);
    // A step in half precision may be a little too small for the largest value, or 0.
    steps[i][0] = static_cast<float>(step) > 0 ? static_cast<float>(step) : 1;
  }
  add(steps);
  put(bytes_, static_cast<std::uint32_t>(rows.width), 4);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const float value : rows[i])
      put(bytes_,
          static_cast<std::uint8_t>(std::lround(std::clamp(value / steps[i][0], -kCoarsest, kCoarsest))), 1);
}

FloatRows LearnedReader::next_coarse() {
  const FloatRows steps = next();
  FloatRows rows = rows_of(get(rest_, 4), steps.size(), 1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (float& value : rows[i])
      value = steps[i][0] * static_cast<float>(static_cast<std::int8_t>(get(rest_, 1)));
  return rows;
}

FloatRows LearnedReader::rows_of(std::size_t width, std::size_t count, std::size_t bytes) {
  if (width * count > rest_.size() / bytes) get(rest_, rest_.size() + 1);
  return make_float_rows(width, count);
}

FloatRows LearnedReader::next() {
  const std::size_t width = get(rest_, 4), count = get(rest_, 4);
  FloatRows rows = rows_of(width, count, 2);
  for (float& value : rows.values) value = cv::float16_t::fromBits(static_cast<std::uint16_t>(get(rest_, 2)));
  return rows;
}

}  // namespace place
