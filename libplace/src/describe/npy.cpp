#include "place/describe/npy.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>
#include <opencv2/core/cvdef.h>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace place {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in the file");

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::string_view kExpected =
    "an array of NumPy's .npy format: rows of float32, float16, uint8 or int8";

/// The value of `key` in the header, a Python dictionary; empty if there is none.
std::string_view value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  std::string_view rest = header.substr(at + key.size());
  rest.remove_prefix(std::min(rest.find_first_not_of("': "), rest.size()));
  return rest;
}

struct Shape {
  std::size_t rows = 0, width = 0;
};

/// "(3, 4), ..." ; none unless there are two dimensions.
bool parse_shape(std::string_view text, Shape& shape) {
  if (!text.starts_with('(')) return false;
  text.remove_prefix(1);
  for (std::size_t* side : {&shape.rows, &shape.width}) {
    text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *side);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  text.remove_prefix(std::min(text.find_first_not_of(", "), text.size()));
  return text.starts_with(')');
}

std::string header_of(std::string_view type, std::size_t rows, std::size_t width) {
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}", type, rows, width);
  constexpr std::size_t kPrefix = 10, kAlign = 64;  // bytes before the header, and the alignment of the data
  header.append(kAlign - 1 - (kPrefix + header.size()) % kAlign, ' ');
  header.push_back('\n');
  std::string out(kMagic);
  out += {'\x01', '\x00', static_cast<char>(header.size() & 0xff), static_cast<char>(header.size() >> 8)};
  return out + header;
}

void write(const std::filesystem::path& path, std::string header, const void* data, std::size_t bytes) {
  header.append(static_cast<const char*>(data), bytes);
  vo::write_file(path, header);
}

void check_finite(const std::string& name, const FloatRows& rows) {
  const auto at = std::ranges::find_if_not(rows.values, [](float value) { return std::isfinite(value); });
  if (at == rows.values.end()) return;
  const auto index = static_cast<std::size_t>(at - rows.values.begin());
  throw vo::Error(name,
                  fmt::format("holds {} in row {}, column {}", *at, index / rows.width, index % rows.width),
                  "finite numbers");
}

}  // namespace

FloatRows read_npy(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::ifstream file(path, std::ios::binary);
  if (!file) throw vo::Error(name, "cannot be read", kExpected);
  const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string_view bytes = content;
  if (!bytes.starts_with(kMagic) || bytes.size() < 12) throw vo::Error(name, "is no .npy file", kExpected);
  const std::size_t length_bytes = bytes[6] == 1 ? 2 : 4;  // of the header's length, from version 2 on
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i)
    length |= static_cast<std::size_t>(static_cast<unsigned char>(bytes[8 + i])) << (8 * i);
  const std::size_t begin = 8 + length_bytes + length;
  if (begin > bytes.size()) throw vo::Error(name, "breaks off", kExpected);
  const std::string_view header = bytes.substr(8 + length_bytes, length);

  Shape shape;
  if (!parse_shape(value_of(header, "'shape'"), shape))
    throw vo::Error(name, "has not two dimensions", "one row for each described frame");
  if (!value_of(header, "'fortran_order'").starts_with("False"))
    throw vo::Error(name, "is in Fortran order", "C order: numpy.ascontiguousarray");
  const std::string_view type = value_of(header, "'descr'").substr(0, 3);
  const std::size_t size = type == "<f4" ? 4 : type == "<f2" ? 2 : type == "|u1" || type == "|i1" ? 1 : 0;
  if (size == 0) throw vo::Error(name, fmt::format("holds numbers of type '{}'", type), kExpected);
  const std::string_view data = bytes.substr(begin);
  const std::size_t numbers = data.size() / size;
  const bool whole =
      data.size() % size == 0 && shape.width > 0 &&
      (shape.rows == 0 ? numbers == 0 : numbers % shape.rows == 0 && numbers / shape.rows == shape.width);
  if (!whole)
    throw vo::Error(
        name,
        fmt::format("holds {} bytes where {} x {} numbers should be", data.size(), shape.rows, shape.width),
        kExpected);

  FloatRows rows = make_float_rows(shape.width, shape.rows);
  if (size == 4) std::ranges::copy(data, reinterpret_cast<char*>(rows.values.data()));
  for (std::size_t i = 0; i < rows.values.size() && size < 4; ++i) {
    std::uint16_t half = 0;
    if (size == 2) std::memcpy(&half, data.data() + 2 * i, 2);
    if (size == 2) {
      rows.values[i] = static_cast<float>(cv::float16_t::fromBits(half));
    } else {
      rows.values[i] = type == "|i1" ? static_cast<float>(static_cast<signed char>(data[i]))
                                     : static_cast<float>(static_cast<unsigned char>(data[i]));
    }
  }
  check_finite(name, rows);
  return rows;
}

void write_npy(const std::filesystem::path& path, const FloatRows& rows) {
  write(path, header_of("<f4", rows.size(), rows.width), rows.values.data(),
        rows.values.size() * sizeof(float));
}

void write_npy(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, std::size_t width) {
  if (width == 0 || bytes.size() % width != 0) throw std::invalid_argument("write_npy: whole rows expected");
  write(path, header_of("|u1", bytes.size() / width, width), bytes.data(), bytes.size());
}

void write_npy(const std::filesystem::path& path, std::span<const std::int8_t> bytes, std::size_t width) {
  if (width == 0 || bytes.size() % width != 0) throw std::invalid_argument("write_npy: whole rows expected");
  write(path, header_of("|i1", bytes.size() / width, width), bytes.data(), bytes.size());
}

std::size_t write_npy(const std::filesystem::path& path, const Descriptors& descriptors) {
  if (const auto* images = std::get_if<vo::ImageStack>(&descriptors)) {
    write_npy(path, images->pixels, images->image_size());
    return images->image_size();
  }
  if (const auto* stack = std::get_if<ColumnStack>(&descriptors)) {
    write_npy(path, FloatRows{.width = stack->descriptor_size(),
                              .values = {stack->values.begin(), stack->values.end()}});
    return stack->descriptor_size();
  }
  const auto& rows = std::get<FloatRows>(descriptors);
  write_npy(path, rows);
  return rows.width;
}

}  // namespace place
