// A route database. Half of the inputs are changed as bytes of the file, half by SQL: values of any kind in
// any column, rows gone or there twice, tables that are views; their checksums mostly fit, as in a file made
// to deceive.
#include "fuzz.hpp"
#include "route/descriptor_rows.hpp"

#include <array>
#include <cstdlib>
#include <cstring>
#include <random>

#include <fmt/format.h>
#include <sqlite3.h>

#include <place/route/named_places.hpp>
#include <place/route/route_database.hpp>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

// SQLite's cache, of fixed size, for two files at once; and its list of a row's further pages, 8 bytes for
// each of 508 of the 4 GB that a damaged row may claim to have.
constexpr std::size_t kPages = 6U << 20U, kFurtherPages = 68U << 20U;

struct Column {
  const char *table, *name;
};
constexpr std::array kColumns{Column{"route", "software_version"},
                              Column{"route", "unit"},
                              Column{"route", "metric"},
                              Column{"route", "traverses"},
                              Column{"route", "latitude_deg"},
                              Column{"route", "longitude_deg"},
                              Column{"route_setting", "value"},
                              Column{"traverse", "id"},
                              Column{"traverse", "name"},
                              Column{"traverse", "source"},
                              Column{"traverse", "frames"},
                              Column{"traverse", "duration_s"},
                              Column{"traverse", "frame_width_px"},
                              Column{"traverse", "frame_height_px"},
                              Column{"traverse", "pose_source"},
                              Column{"traverse", "surveyed"},
                              Column{"traverse", "keyframes"},
                              Column{"traverse", "thumbnail_width"},
                              Column{"traverse", "thumbnail_height"},
                              Column{"learned", "bytes"},
                              Column{"descriptor", "form"},
                              Column{"descriptor", "width"},
                              Column{"descriptor", "height"},
                              Column{"descriptor_chunk", "first"},
                              Column{"descriptor_chunk", "bytes"},
                              Column{"setting", "name"},
                              Column{"setting", "value"},
                              Column{"keyframe", "position"},
                              Column{"keyframe", "frame"},
                              Column{"keyframe", "time_s"},
                              Column{"keyframe", "displacement"},
                              Column{"keyframe", "distance_m"},
                              Column{"keyframe", "x_m"},
                              Column{"keyframe", "heading_rad"},
                              Column{"keyframe", "after_gap"},
                              Column{"thumbnail_chunk", "pixels"},
                              Column{"preview", "position"},
                              Column{"preview", "jpeg"},
                              Column{"view_points", "bytes"},
                              Column{"named_place", "name"},
                              Column{"named_place", "frame"},
                              Column{"named_place", "distance_m"}};

constexpr std::array kValues{"NULL",
                             "0",
                             "1",
                             "-1",
                             "2",
                             "7",
                             "255",
                             "1024",
                             "16777216",
                             "2147483648",
                             "4611686018427387904",
                             "-9223372036854775808",
                             "0.5",
                             "-0.0",
                             "1e308",
                             "9e999",
                             "-9e999",
                             "''",
                             "'pixels'",
                             "'floats'",
                             "'columns'",
                             "char(0,27,65)",
                             "CAST(x'ff80' AS TEXT)",
                             "x''",
                             "x'00ff01'",
                             "zeroblob(64)",
                             "zeroblob(3000)",
                             "replace(hex(zeroblob(300)), '0', 'x')"};

constexpr std::array kWhole{
    "DELETE FROM keyframe WHERE chance()",
    "DELETE FROM descriptor_chunk WHERE chance()",
    "DELETE FROM traverse WHERE chance()",
    "DELETE FROM route",
    "DELETE FROM preview WHERE chance()",
    "DROP TABLE named_place",
    "DROP TABLE view_points",
    "INSERT INTO keyframe SELECT traverse, position + 3, frame + 30, time_s + 1, displacement, distance_m, "
    "x_m, y_m, heading_rad, after_gap FROM keyframe",
    "INSERT INTO traverse SELECT id + 2, name || 'x', source, frames, duration_s, frame_width_px, "
    "frame_height_px, pose_source, surveyed, keyframes, thumbnail_width, thumbnail_height FROM traverse",
    "INSERT INTO descriptor SELECT traverse, descriptor + 3, form, width, height FROM descriptor",
    "ALTER TABLE keyframe RENAME TO old; CREATE VIEW keyframe AS WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL "
    "SELECT i + 1 FROM n) SELECT 1 AS traverse, i AS position, i AS frame, i AS time_s, i AS displacement, "
    "i AS distance_m, 0 AS x_m, 0 AS y_m, 0 AS heading_rad, 0 AS after_gap FROM n",
    "ALTER TABLE traverse RENAME TO old; CREATE VIEW traverse AS SELECT * FROM old",
    "DROP TABLE learned; CREATE TABLE learned(descriptor INTEGER PRIMARY KEY, checksum AS (1), bytes AS "
    "(zeroblob(100000000)))",
    "PRAGMA user_version = 1"};

// Digests of rows, which would find every change first, are left out: a route of an older version has none.
constexpr const char* kFitChecksums =
    "DROP TABLE IF EXISTS row_digest;"
    "UPDATE learned SET checksum = checksum_of(bytes);"
    "UPDATE descriptor_chunk SET checksum = checksum_of(bytes);"
    "UPDATE thumbnail_chunk SET checksum = checksum_of(pixels);"
    "UPDATE view_points SET checksum = checksum_of(bytes);";

using Random = std::minstd_rand;

void checksum_of(sqlite3_context* context, int, sqlite3_value** values) {
  const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_value_blob(values[0]));
  const auto size = static_cast<std::size_t>(sqlite3_value_bytes(values[0]));
  sqlite3_result_int64(context, place::descriptor_rows::checksum({bytes, size}));
}

void chance(sqlite3_context* context, int, sqlite3_value**) {
  auto& random = *static_cast<Random*>(sqlite3_user_data(context));
  sqlite3_result_int(context, random() / 16 % 3 == 0 ? 1 : 0);
}

std::string statement(Random& random) {
  const auto one_of = [&](const auto& list) { return list[random() / 16 % list.size()]; };
  constexpr std::size_t kSeldom = 4;
  if (random() / 16 % kSeldom == 0) return one_of(kWhole);
  const Column column = one_of(kColumns);
  return fmt::format("UPDATE OR REPLACE {} SET {} = {} WHERE chance()", column.table, column.name,
                     one_of(kValues));
}

/// The file after some statements; unchanged where SQLite cannot read it or it would be too long.
std::size_t changed_by_sql(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  Random random(seed + 1);
  sqlite3* database = nullptr;
  if (sqlite3_open(":memory:", &database) != SQLITE_OK) std::abort();
  auto* image = static_cast<std::uint8_t*>(sqlite3_malloc64(size + 1));
  std::memcpy(image, data, size);
  sqlite3_deserialize(database, "main", image, static_cast<std::int64_t>(size),
                      static_cast<std::int64_t>(size),
                      SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
  sqlite3_create_function(database, "checksum_of", 1, SQLITE_UTF8, nullptr, checksum_of, nullptr, nullptr);
  sqlite3_create_function(database, "chance", 0, SQLITE_UTF8, &random, chance, nullptr, nullptr);
  constexpr std::size_t kStatements = 3;
  for (std::size_t i = 0; i <= random() / 16 % kStatements; ++i)
    sqlite3_exec(database, statement(random).c_str(), nullptr, nullptr, nullptr);
  if (random() / 16 % 4 != 0) sqlite3_exec(database, kFitChecksums, nullptr, nullptr, nullptr);
  sqlite3_int64 length = 0;
  unsigned char* changed = sqlite3_serialize(database, "main", &length, 0);
  if (changed != nullptr && static_cast<std::size_t>(length) <= most) {
    size = static_cast<std::size_t>(length);
    std::memcpy(data, changed, size);
  }
  sqlite3_free(changed);
  sqlite3_close(database);
  return size;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return seed % 2 == 0 ? LLVMFuzzerMutate(data, size, most) : changed_by_sql(data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::write("route.db", {data, size});
  fuzz::call(
      size,
      [&] {
        const place::Route route = place::read_route(file);
        for (std::size_t t = 0; t < route.traverses.size(); ++t) {
          place::gaps_of(route.traverses[t]);
          place::places_on(route, t);
        }
        place::write_route(fuzz::folder() / "again.db", route);  // what was read can be written
      },
      kPages + kFurtherPages);
  return 0;
}
