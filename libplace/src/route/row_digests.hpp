#pragma once

#include "route/sqlite.hpp"

#include <cstdint>
#include <optional>
#include <string>

/// Digests of the rows of a route database, so that a flipped bit in any of them is found and named instead
/// of becoming a wrong distance or a wrong picture. SQLite itself finds only damage to the structure of a
/// page. Chunks of descriptors and thumbnails have checksums of their own; of these tables the digest covers
/// the keys and the checksums. A database from before there were digests is read without.
namespace place::row_digests {

/// Stores a digest of each table. Call it when all rows are written. O(rows).
void write(const sqlite::Database& database);

/// Throws `vo::Error` naming `path` and the table whose rows do not match their digest. `previews`: whether
/// the pictures are read, and therefore checked, too. O(rows).
void check(const sqlite::Database& database, const std::string& path, bool previews);

/// One digest of all of them, which tells a route from another one at the same path; none without digests.
std::optional<std::int64_t> of_all(const sqlite::Database& database);

}  // namespace place::row_digests
