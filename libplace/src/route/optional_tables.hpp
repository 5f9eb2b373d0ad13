#pragma once

#include "place/route/route.hpp"
#include "route/sqlite.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Tables of a route database that a route has only if it needs them: SURF points of keyframes, and places
/// with names. A route without is as if they were empty, so that routes from before there were such tables
/// are read.
namespace place::optional_tables {

/// Creates those that a route needs.
void create(const sqlite::Database& database, const Route& route);

/// Writes a traverse's rows.
void write(const sqlite::Database& database, std::int64_t id, const Traverse& traverse);

/// The points of a traverse's keyframes; none if it has none. Throws `vo::Error` naming `path` if they do not
/// fit their checksums, or some are missing.
std::vector<Bytes> read_points(const sqlite::Database& database, const std::string& path, std::int64_t id,
                               std::size_t keyframes);

std::vector<NamedPlace> read_places(const sqlite::Database& database, const std::string& path,
                                    std::int64_t id);

}  // namespace place::optional_tables
