#include "route/optional_tables.hpp"

#include "route/descriptor_rows.hpp"

#include <cmath>
#include <span>
#include <string_view>

namespace place::optional_tables {
namespace {

using descriptor_rows::checksum;
using descriptor_rows::damaged;
using sqlite::Database;
using sqlite::Statement;

constexpr const char* kPointsSchema = R"sql(
CREATE TABLE view_points(
  traverse INTEGER NOT NULL REFERENCES traverse, position INTEGER NOT NULL, checksum INTEGER NOT NULL,
  bytes BLOB NOT NULL, PRIMARY KEY(traverse, position));
)sql";

constexpr const char* kPlacesSchema = R"sql(
CREATE TABLE named_place(
  traverse INTEGER NOT NULL REFERENCES traverse, position INTEGER NOT NULL, name TEXT NOT NULL,
  frame INTEGER NOT NULL, distance_m REAL, PRIMARY KEY(traverse, position)) WITHOUT ROWID;
)sql";

bool has_table(const Database& database, std::string_view name) {
  return database.prepare("SELECT 1 FROM sqlite_master WHERE name = ?").bind(name).step();
}

void write_points(const Database& database, std::int64_t id, const std::vector<Bytes>& points) {
  if (points.empty()) return;
  Statement row = database.prepare("INSERT INTO view_points VALUES(?,?,?,?)");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::span<const std::uint8_t> bytes = points[i];
    row.bind(id).bind(static_cast<std::int64_t>(i)).bind(checksum(bytes)).bind(bytes).execute();
  }
}

void write_places(const Database& database, std::int64_t id, const std::vector<NamedPlace>& places) {
  if (places.empty()) return;
  Statement row = database.prepare("INSERT INTO named_place VALUES(?,?,?,?,?)");
  for (std::size_t i = 0; i < places.size(); ++i) {
    const NamedPlace& place = places[i];
    row.bind(id).bind(static_cast<std::int64_t>(i)).bind(place.name).bind(place.frame);
    row.bind(place.distance_m).execute();
  }
}

}  // namespace

void create(const Database& database, const Route& route) {
  if (has_view_points(route)) database.run(kPointsSchema);
  if (has_named_places(route)) database.run(kPlacesSchema);
}

void write(const Database& database, std::int64_t id, const Traverse& traverse) {
  write_points(database, id, traverse.view_points);
  write_places(database, id, traverse.places);
}

std::vector<Bytes> read_points(const Database& database, const std::string& path, std::int64_t id,
                               std::size_t keyframes) {
  std::vector<Bytes> points;
  if (!has_table(database, "view_points")) return points;
  Statement row =
      database.prepare("SELECT checksum, bytes FROM view_points WHERE traverse = ? ORDER BY position");
  row.bind(id);
  while (row.step()) {
    const std::int64_t expected = row.integer();
    const std::span<const std::uint8_t> bytes = row.blob();
    if (checksum(bytes) != expected) damaged(path, "the points of a keyframe do not fit their checksum");
    points.emplace_back(bytes.begin(), bytes.end());
  }
  if (!points.empty() && points.size() != keyframes) damaged(path, "points of keyframes are missing");
  return points;
}

std::vector<NamedPlace> read_places(const Database& database, const std::string& path, std::int64_t id) {
  std::vector<NamedPlace> places;
  if (!has_table(database, "named_place")) return places;
  Statement row = database.prepare(
      "SELECT name, frame, distance_m FROM named_place WHERE traverse = ? ORDER BY position");
  row.bind(id);
  while (row.step()) {
    NamedPlace& place = places.emplace_back();
    place.name = row.text();
    place.frame = row.integer();
    place.distance_m = row.optional_real();
    const bool placed = places.size() == 1 || place.frame >= places[places.size() - 2].frame;
    if (place.name.empty() || place.frame < 0 || !placed || !std::isfinite(place.distance_m.value_or(0)))
      damaged(path, "a named place is none");
  }
  return places;
}

}  // namespace place::optional_tables
