#include "route/row_digests.hpp"

#include "route/descriptor_rows.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace place::row_digests {
namespace {

using sqlite::Database;
using sqlite::Statement;

struct Table {
  std::string_view name;
  std::string_view rows;  ///< the query of what the digest covers, in the order of the key
  bool pictures = false;
};

constexpr std::array kTables{
    Table{"route", "SELECT * FROM route"},
    Table{"route_setting", "SELECT * FROM route_setting ORDER BY name"},
    Table{"traverse", "SELECT * FROM traverse ORDER BY id"},
    Table{"setting", "SELECT * FROM setting ORDER BY traverse, name"},
    Table{"keyframe", "SELECT * FROM keyframe ORDER BY traverse, position"},
    Table{"learned", "SELECT descriptor, checksum FROM learned ORDER BY descriptor"},
    Table{"descriptor", "SELECT * FROM descriptor ORDER BY traverse, descriptor"},
    Table{"descriptor_chunk",
          "SELECT traverse, descriptor, first, checksum FROM descriptor_chunk ORDER BY traverse, descriptor, "
          "first"},
    Table{"thumbnail_chunk",
          "SELECT traverse, first, checksum FROM thumbnail_chunk ORDER BY traverse, first"},
    Table{"view_points", "SELECT traverse, position, checksum FROM view_points ORDER BY traverse, position"},
    Table{"named_place", "SELECT * FROM named_place ORDER BY traverse, position"},
    Table{"preview", "SELECT * FROM preview ORDER BY traverse, position", true},
};

bool exists(const Database& database, std::string_view table) {
  return database.prepare("SELECT 1 FROM sqlite_master WHERE name = ?").bind(table).step();
}

std::int64_t digest_of(const Database& database, const Table& table) {
  constexpr std::uint64_t kBegin = 0xcbf29ce484222325U;  // FNV's
  Statement rows = database.prepare(table.rows);
  std::uint64_t digest = kBegin;
  while (rows.step()) digest = rows.digest(digest);
  return std::bit_cast<std::int64_t>(digest);
}

constexpr std::string_view kTable = "row_digest";

}  // namespace

std::optional<std::int64_t> of_all(const Database& database) {
  if (!exists(database, kTable)) return std::nullopt;
  return digest_of(database, {kTable, "SELECT * FROM row_digest ORDER BY name"});
}

void write(const Database& database) {
  database.run("CREATE TABLE row_digest(name TEXT PRIMARY KEY, digest INTEGER NOT NULL) WITHOUT ROWID");
  for (const Table& table : kTables) {
    if (!exists(database, table.name)) continue;
    database.prepare("INSERT INTO row_digest VALUES(?,?)")
        .bind(table.name)
        .bind(digest_of(database, table))
        .execute();
  }
}

void check(const Database& database, const std::string& path, bool previews) {
  if (!exists(database, kTable)) return;
  for (const Table& table : kTables) {
    if (table.pictures && !previews) continue;
    std::optional<std::int64_t> stored;
    Statement row = database.prepare("SELECT digest FROM row_digest WHERE name = ?");
    if (row.bind(table.name).step()) stored = row.integer();
    const bool is_there = exists(database, table.name);
    if (is_there != stored.has_value() || (is_there && digest_of(database, table) != *stored))
      descriptor_rows::damaged(path, fmt::format("rows of its table '{}' have changed", table.name));
  }
}

}  // namespace place::row_digests
