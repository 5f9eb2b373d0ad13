#pragma once

#include "place/route/route_database.hpp"
#include "route/sqlite.hpp"

#include <cstdint>
#include <string>

/// The rows of one traverse in a route database: its own, and those of its settings, keyframes, pictures and
/// descriptors.
namespace place::traverse_rows {

/// The settings that a statement returns as name and value. Throws `vo::Error` naming `path` for one that
/// there is not, or a value that is none.
Settings read_settings(sqlite::Statement& rows, const std::string& path);

/// Writes a traverse under a number of its own. O(traverse).
void write(const sqlite::Database& database, std::int64_t id, const Traverse& traverse);

/// Reads it, as far as `options` say. Throws `vo::Error` naming `path` for rows that are missing or do not
/// fit each other. O(traverse).
Traverse read(const sqlite::Database& database, const std::string& path, std::int64_t id,
              const RouteReadOptions& options);

}  // namespace place::traverse_rows
