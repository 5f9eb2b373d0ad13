#include "place/route/route_database.hpp"

#include "place/version.hpp"
#include "route/descriptor_rows.hpp"
#include "route/optional_tables.hpp"
#include "route/row_digests.hpp"
#include "route/sqlite.hpp"
#include "route/traverse_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace place {
namespace {

using descriptor_rows::checksum;
using descriptor_rows::damaged;
using descriptor_rows::form_of;
using sqlite::Database;
using sqlite::Statement;

constexpr std::int64_t kApplicationId = 0x72747263;  // "rtrc", in the header of the file

// Settings that walks adopt are stored as key and value, so that a new setting changes no table.
constexpr const char* kSchema = R"sql(
CREATE TABLE route(
  software_version TEXT NOT NULL, unit REAL NOT NULL, metric INTEGER NOT NULL, traverses INTEGER NOT NULL,
  latitude_deg REAL, longitude_deg REAL);
CREATE TABLE route_setting(name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE traverse(
  id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, source TEXT NOT NULL, frames INTEGER NOT NULL,
  duration_s REAL NOT NULL, frame_width_px INTEGER NOT NULL, frame_height_px INTEGER NOT NULL,
  pose_source TEXT NOT NULL, surveyed INTEGER NOT NULL, keyframes INTEGER NOT NULL,
  thumbnail_width INTEGER NOT NULL, thumbnail_height INTEGER NOT NULL);
CREATE TABLE learned(descriptor INTEGER PRIMARY KEY, checksum INTEGER NOT NULL, bytes BLOB NOT NULL);
CREATE TABLE descriptor(
  traverse INTEGER NOT NULL REFERENCES traverse, descriptor INTEGER NOT NULL, form TEXT NOT NULL,
  width INTEGER NOT NULL, height INTEGER NOT NULL, PRIMARY KEY(traverse, descriptor)) WITHOUT ROWID;
CREATE TABLE descriptor_chunk(
  traverse INTEGER NOT NULL REFERENCES traverse, descriptor INTEGER NOT NULL, first INTEGER NOT NULL,
  checksum INTEGER NOT NULL, bytes BLOB NOT NULL, PRIMARY KEY(traverse, descriptor, first));
CREATE TABLE setting(
  traverse INTEGER NOT NULL REFERENCES traverse, name TEXT NOT NULL, value TEXT NOT NULL,
  PRIMARY KEY(traverse, name)) WITHOUT ROWID;
CREATE TABLE keyframe(
  traverse INTEGER NOT NULL REFERENCES traverse, position INTEGER NOT NULL,
  frame INTEGER NOT NULL, time_s REAL NOT NULL, displacement REAL NOT NULL,
  distance_m REAL, x_m REAL, y_m REAL, heading_rad REAL, after_gap INTEGER NOT NULL,
  PRIMARY KEY(traverse, position)) WITHOUT ROWID;
CREATE TABLE thumbnail_chunk(
  traverse INTEGER NOT NULL REFERENCES traverse, first INTEGER NOT NULL, checksum INTEGER NOT NULL,
  pixels BLOB NOT NULL, PRIMARY KEY(traverse, first));
CREATE TABLE preview(
  traverse INTEGER NOT NULL REFERENCES traverse, position INTEGER NOT NULL, jpeg BLOB NOT NULL,
  PRIMARY KEY(traverse, position));
)sql";

void check(const Route& route) {
  std::set<std::string> names;
  for (const Traverse& traverse : route.traverses) {
    if (!names.insert(traverse.name).second)
      throw std::invalid_argument("write_route: two traverses share a name");
    const auto& first = route.traverses.front().descriptors;
    bool fit = traverse.descriptors.size() == route.learned.size();
    for (std::size_t i = 0; fit && i < traverse.descriptors.size(); ++i) {
      fit = count_of(traverse.descriptors[i]) == traverse.keyframes.size() &&
            form_of(traverse.descriptors[i]) == form_of(first[i]);
    }
    if (!fit || (!traverse.thumbnails.empty() && traverse.thumbnails.size() != traverse.keyframes.size())) {
      throw std::invalid_argument(
          "write_route: a traverse's descriptors do not fit its keyframes or the other traverses'");
    }
    if (!traverse.view_points.empty() && traverse.view_points.size() != traverse.keyframes.size())
      throw std::invalid_argument("write_route: points of every keyframe or of none expected");
  }
}

/// The traverses have names of their own and the same descriptors.
void check_alike(const Route& route, const std::string& path) {
  std::set<std::string_view> names;
  for (const Traverse& traverse : route.traverses) {
    if (!names.insert(traverse.name).second) damaged(path, "two traverses share a name");
    for (std::size_t i = 0; i < traverse.descriptors.size(); ++i) {
      if (form_of(traverse.descriptors[i]) != form_of(route.traverses.front().descriptors[i]))
        damaged(path, "descriptors of two traverses differ in form");
    }
  }
}

}  // namespace

Route read_route(const std::filesystem::path& path, const RouteReadOptions& options) {
  const std::string shown = path.string();
  if (!std::filesystem::exists(path))
    throw vo::Error(shown, "does not exist", "a file written by `retrace build`");
  if (!std::filesystem::is_regular_file(path)) throw vo::Error(shown, "is no file", "a route database");
  const Database database(path, Database::Mode::kReadOnly, shown);

  Statement application = database.prepare("PRAGMA application_id");
  if (!application.step() || application.integer() != kApplicationId) {
    throw vo::Error(shown, "is no route database", "a file written by `retrace build`");
  }
  Statement version = database.prepare("PRAGMA user_version");
  version.step();
  const std::int64_t schema = version.integer();
  if (schema != kRouteSchemaVersion) {
    throw vo::Error(shown,
                    fmt::format("has schema version {}, written by another version of retrace", schema),
                    fmt::format("schema version {}; build the route again", kRouteSchemaVersion));
  }

  database.check_stored_values();

  // SQLite pads a truncated last page with zeros. If there is a file of pending changes, pages may be there.
  std::error_code ignored;
  const bool whole_file = !std::filesystem::exists(shown + "-wal", ignored);
  Statement size = database.prepare("SELECT page_count * page_size FROM pragma_page_count, pragma_page_size");
  if (!size.step() ||
      (whole_file && size.integer() != static_cast<std::int64_t>(std::filesystem::file_size(path)))) {
    damaged(shown, "it is cut short");
  }

  row_digests::check(database, shown, options.previews);
  const std::optional<std::int64_t> digest = row_digests::of_all(database);
  Statement row = database.prepare(
      "SELECT software_version, unit, metric, traverses, latitude_deg, longitude_deg FROM route");
  if (!row.step()) damaged(shown, "the route's row is missing");
  Route route;
  route.software_version = row.text();
  route.digest = digest;
  route.unit = row.real();
  route.metric = row.integer() != 0;
  const std::int64_t traverses = row.integer();
  const std::optional<double> latitude_deg = row.optional_real(), longitude_deg = row.optional_real();
  if (latitude_deg && longitude_deg) route.origin = {*latitude_deg, *longitude_deg};
  if (!(route.unit >= 0) || !std::isfinite(route.unit) ||
      (route.origin && !(std::abs(*latitude_deg) <= 90 && std::abs(*longitude_deg) <= 360)))
    damaged(shown, "the route's unit or origin is none");
  Statement settings = database.prepare("SELECT name, value FROM route_setting ORDER BY name");
  route.settings = traverse_rows::read_settings(settings, shown);
  Statement learned = database.prepare("SELECT checksum, bytes FROM learned ORDER BY descriptor");
  while (learned.step()) {
    const std::int64_t expected = learned.integer();
    const std::span<const std::uint8_t> bytes = learned.blob();
    if (checksum(bytes) != expected) damaged(shown, "what it learned does not fit its checksum");
    route.learned.emplace_back(bytes.begin(), bytes.end());
  }
  for (std::int64_t id = 1; id <= traverses; ++id) {
    route.traverses.push_back(traverse_rows::read(database, shown, id, options));
    if (options.descriptors && route.traverses.back().descriptors.size() != route.learned.size())
      damaged(shown, "descriptors are missing");
  }
  check_alike(route, shown);
  return route;
}

void read_previews(const std::filesystem::path& path, Route& route, std::size_t traverse,
                   std::span<const std::size_t> keyframes) {
  const Database database(path, Database::Mode::kReadOnly, path.string());
  if (row_digests::of_all(database) != route.digest)
    throw vo::Error(path.string(), "has changed since it was read", "no build on it meanwhile");
  std::vector<Keyframe>& all = route.traverses.at(traverse).keyframes;
  for (const std::size_t keyframe : keyframes) {
    if (!all.at(keyframe).preview_jpeg.empty()) continue;  // asked for before
    Statement preview = database.prepare("SELECT jpeg FROM preview WHERE traverse = ? AND position = ?");
    preview.bind(static_cast<std::int64_t>(traverse) + 1).bind(static_cast<std::int64_t>(keyframe));
    if (!preview.step()) continue;
    const std::span<const std::uint8_t> jpeg = preview.blob();
    all.at(keyframe).preview_jpeg.assign(jpeg.begin(), jpeg.end());
  }
}

bool looks_like_route(const std::filesystem::path& path) {
  constexpr std::string_view kSqlite{"SQLite format 3\0", 16};  // https://www.sqlite.org/fileformat.html
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::ifstream file(path, std::ios::binary);
  std::array<char, kSqlite.size()> begin{};
  return file.read(begin.data(), begin.size()) && std::string_view(begin.data(), begin.size()) == kSqlite;
}

void write_route(const std::filesystem::path& named, const Route& route) {
  check(route);
  // A link goes on naming the route: what it names is replaced.
  const std::filesystem::path path =
      std::filesystem::is_symlink(named) ? std::filesystem::weakly_canonical(named) : named;
  if (std::filesystem::is_directory(path)) throw vo::Error(path.string(), "is a folder", "a file to write");
  vo::remove_abandoned(path);
  vo::AtomicFile file(path);
  {
    const Database database(file.temporary(), Database::Mode::kCreate, path.string());
    // No journal: nobody reads this file before the rename, and a broken one is discarded whole. Pages of 16
    // kB: thumbnails take a quarter of the reads of SQLite's usual 4 kB.
    database.run("PRAGMA page_size = 16384; PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;");
    database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kApplicationId,
                             kRouteSchemaVersion));
    database.run("BEGIN");
    database.run(kSchema);
    optional_tables::create(database, route);
    database.prepare("INSERT INTO route VALUES(?,?,?,?,?,?)")
        .bind(std::string_view(kVersion))
        .bind(route.unit)
        .bind(std::int64_t{route.metric ? 1 : 0})
        .bind(static_cast<std::int64_t>(route.traverses.size()))
        .bind(route.origin ? std::optional(route.origin->latitude_deg) : std::nullopt)
        .bind(route.origin ? std::optional(route.origin->longitude_deg) : std::nullopt)
        .execute();
    Statement row = database.prepare("INSERT INTO route_setting VALUES(?,?)");
    for (const Setting& setting : settings_table()) {
      const std::optional<std::string> value = text_of(route.settings, setting);
      if (value) row.bind(setting.name).bind(*value).execute();
    }
    Statement learned = database.prepare("INSERT INTO learned VALUES(?,?,?)");
    for (std::size_t i = 0; i < route.learned.size(); ++i) {
      const std::span<const std::uint8_t> bytes = route.learned[i];
      learned.bind(static_cast<std::int64_t>(i)).bind(checksum(bytes)).bind(bytes).execute();
    }
    for (std::size_t i = 0; i < route.traverses.size(); ++i) {
      traverse_rows::write(database, static_cast<std::int64_t>(i) + 1, route.traverses[i]);
    }
    row_digests::write(database);
    database.run("COMMIT");
  }
  sqlite::fold_changes(path);
  file.commit();
}

}  // namespace place
