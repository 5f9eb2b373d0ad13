#include "route/descriptor_rows.hpp"

#include "place/describe/quantise.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place::descriptor_rows {
namespace {

using sqlite::Statement;

constexpr std::string_view kPixels = "pixels", kColumns = "columns", kFloats = "floats";

}  // namespace

Form form_of(const Descriptors& descriptors) {
  if (const auto* images = std::get_if<vo::ImageStack>(&descriptors))
    return {kPixels, images->width, images->height, images->image_size()};
  if (const auto* stack = std::get_if<ColumnStack>(&descriptors))
    return {kColumns, stack->columns, stack->channels, stack->descriptor_size()};
  const auto& rows = std::get<FloatRows>(descriptors);
  return {kFloats, static_cast<std::int64_t>(rows.width), 1, rows.width * sizeof(float)};
}

std::span<const std::uint8_t> bytes_of(const Descriptors& descriptors) {
  return std::visit(
      [](const auto& rows) -> std::span<const std::uint8_t> {
        if constexpr (requires { rows.pixels; }) {
          return rows.pixels;
        } else {
          return {reinterpret_cast<const std::uint8_t*>(rows.values.data()),
                  rows.values.size() * sizeof(rows.values[0])};
        }
      },
      descriptors);
}

std::optional<Descriptors> make_of_form(std::string_view name, std::int64_t width, std::int64_t height,
                                        std::size_t count) {
  constexpr std::int64_t kLargest = 1 << 24;  // bytes of one descriptor; anything larger is an error
  if (width < 0 || height < 0 || width > kLargest || height > kLargest || width * height > kLargest)
    return {};
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  if (name == kPixels) return vo::make_image_stack(w, h, count);
  if (name == kColumns) return make_column_stack(w, h, count);
  if (name == kFloats && height == 1) return make_float_rows(static_cast<std::size_t>(width), count);
  return {};
}

std::span<std::uint8_t> bytes_of(Descriptors& descriptors) {
  const std::span<const std::uint8_t> bytes = bytes_of(std::as_const(descriptors));
  return {const_cast<std::uint8_t*>(bytes.data()), bytes.size()};
}

std::int64_t checksum(std::span<const std::uint8_t> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    hash = (hash ^ word) * 0x100000001b3U;
  }
  return std::bit_cast<std::int64_t>(hash);
}

void damaged(const std::string& path, std::string_view what) {
  throw vo::Error(path, fmt::format("is damaged: {}", what), "a whole route database; build it again");
}

void write_chunks(Statement& chunk, std::span<const std::uint8_t> bytes, std::size_t size, std::size_t rows,
                  const std::function<void(Statement&)>& bind_keys) {
  for (std::size_t first = 0; first < rows; first += kChunk) {
    const auto part = bytes.subspan(first * size, std::min(kChunk, rows - first) * size);
    bind_keys(chunk);
    chunk.bind(static_cast<std::int64_t>(first)).bind(checksum(part)).bind(part).execute();
  }
}

void read_chunks(Statement& chunk, std::span<std::uint8_t> missing, const std::string& path,
                 std::string_view what) {
  while (chunk.step()) {
    const std::int64_t expected = chunk.integer();
    const std::span<const std::uint8_t> part = chunk.blob();
    if (checksum(part) != expected)
      damaged(path, fmt::format("a block of {} does not fit its checksum", what));
    if (part.size() > missing.size()) damaged(path, fmt::format("there are more {} than keyframes", what));
    std::ranges::copy(part, missing.begin());
    missing = missing.subspan(part.size());
  }
  if (!missing.empty()) damaged(path, fmt::format("{} are missing", what));
}

}  // namespace place::descriptor_rows
