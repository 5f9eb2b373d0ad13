#pragma once

#include "place/describe/descriptor.hpp"
#include "route/sqlite.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// How a route database stores data with a row for each keyframe, descriptors and thumbnails: the bytes of
/// the rows one after the other, in chunks of 256 rows, each with its checksum.
namespace place::descriptor_rows {

inline constexpr std::size_t kChunk = 256;  ///< rows

/// The layout of descriptors: their form ("pixels", "columns" or "floats"), its two dimensions, and the bytes
/// of one.
struct Form {
  std::string_view name;
  std::int64_t width = 0, height = 0;
  std::size_t bytes = 0;

  bool operator==(const Form&) const = default;
};

Form form_of(const Descriptors& descriptors);

/// `count` descriptors of a form, all 0; none if there is no such form or a dimension is not valid.
std::optional<Descriptors> make_of_form(std::string_view name, std::int64_t width, std::int64_t height,
                                        std::size_t count);

std::span<const std::uint8_t> bytes_of(const Descriptors& descriptors);
std::span<std::uint8_t> bytes_of(Descriptors& descriptors);

/// FNV-1a over 64-bit words, the last one padded with zeros.
std::int64_t checksum(std::span<const std::uint8_t> bytes);

/// Throws `vo::Error` saying that the file at `path` is damaged.
[[noreturn]] void damaged(const std::string& path, std::string_view what);

/// Writes `rows` rows of `size` bytes each. `chunk`: an INSERT of the keys that `bind_keys` binds, then the
/// first row's index, the checksum and the bytes.
void write_chunks(sqlite::Statement& chunk, std::span<const std::uint8_t> bytes, std::size_t size,
                  std::size_t rows, const std::function<void(sqlite::Statement&)>& bind_keys);

/// Fills `missing` from a SELECT of checksum and bytes in the order of the rows. Throws `vo::Error`
/// (`damaged`) if a chunk does not match its checksum, or the number of bytes is wrong.
void read_chunks(sqlite::Statement& chunk, std::span<std::uint8_t> missing, const std::string& path,
                 std::string_view what);

}  // namespace place::descriptor_rows
