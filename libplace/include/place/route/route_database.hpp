#pragma once

#include "place/route/route.hpp"

#include <cstddef>
#include <filesystem>
#include <span>

namespace place {

/// The layout of the file; files with another layout are refused.
inline constexpr int kRouteSchemaVersion = 5;

/// What to read.
struct RouteReadOptions {
  bool previews = true;     ///< read the pictures and thumbnails too
  bool view_points = true;  ///< and the SURF points, where there are any
  bool descriptors = true;  ///< and the descriptors; without them, see `StoredDescriptors`
};

/// Reads a route database: one SQLite file, opened read-only. Descriptors are stored in chunks of 256, each
/// with a checksum, and there is a digest of the rows of every table, so that any flipped bit is found or
/// does no harm. Throws `vo::Error` naming the file if it does not exist, is not a route database, was
/// written by another version, or is damaged (a broken page, rows or chunks that do not match their digest).
/// O(file).
Route read_route(const std::filesystem::path& path, const RouteReadOptions& options = {});

/// Reads the pictures of some keyframes of a traverse into a route that was read without. Throws `vo::Error`
/// as `read_route` does.
void read_previews(const std::filesystem::path& path, Route& route, std::size_t traverse,
                   std::span<const std::size_t> keyframes);

/// True if the file is a SQLite database, as routes are, by its first bytes. Nothing is thrown.
bool looks_like_route(const std::filesystem::path& path);

/// Writes a route, replacing the file at `path`, which is the old one or the new one at any moment. Equal
/// routes give equal bytes. Throws `vo::Error` if it cannot be written, `std::invalid_argument` if a
/// traverse's descriptors do not match its keyframes or the other traverses', or two traverses share a name.
void write_route(const std::filesystem::path& path, const Route& route);

}  // namespace place
