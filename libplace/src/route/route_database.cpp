#include "place/route/route_database.hpp"

#include "place/version.hpp"
#include "route/descriptor_rows.hpp"
#include "route/keyframe_check.hpp"
#include "route/optional_tables.hpp"
#include "route/row_digests.hpp"
#include "route/sqlite.hpp"

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

using descriptor_rows::bytes_of;
using descriptor_rows::checksum;
using descriptor_rows::damaged;
using descriptor_rows::Form;
using descriptor_rows::form_of;
using descriptor_rows::make_of_form;
using descriptor_rows::read_chunks;
using descriptor_rows::write_chunks;
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

/// The settings that a statement returns as name and value.
Settings read_settings(Statement& rows, const std::string& path) {
  Settings settings;
  while (rows.step()) {
    const std::string name = rows.text(), value = rows.text();
    try {
      set(settings, setting_named(name), value);
    } catch (const vo::Error& error) {
      damaged(path, fmt::format("its settings: {}", error.what()));
    }
  }
  return settings;
}

void write_traverse(const Database& database, std::int64_t id, const Traverse& traverse) {
  database.prepare("INSERT INTO traverse VALUES(?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(id)
      .bind(traverse.name)
      .bind(traverse.source)
      .bind(traverse.frames)
      .bind(traverse.duration_s)
      .bind(std::int64_t{traverse.frame_width_px})
      .bind(std::int64_t{traverse.frame_height_px})
      .bind(traverse.pose_source)
      .bind(std::int64_t{traverse.surveyed ? 1 : 0})
      .bind(static_cast<std::int64_t>(traverse.keyframes.size()))
      .bind(std::int64_t{traverse.thumbnails.width})
      .bind(std::int64_t{traverse.thumbnails.height})
      .execute();

  Statement row = database.prepare("INSERT INTO setting VALUES(?,?,?)");
  for (const Setting& setting : settings_table()) {
    const std::optional<std::string> value = text_of(traverse.settings, setting);
    if (value) row.bind(id).bind(setting.name).bind(*value).execute();
  }

  Statement keyframe = database.prepare("INSERT INTO keyframe VALUES(?,?,?,?,?,?,?,?,?,?)");
  Statement preview = database.prepare("INSERT INTO preview VALUES(?,?,?)");
  for (std::size_t i = 0; i < traverse.keyframes.size(); ++i) {
    const Keyframe& k = traverse.keyframes[i];
    const auto position = static_cast<std::int64_t>(i);
    keyframe.bind(id).bind(position).bind(k.frame).bind(k.time_s).bind(k.displacement).bind(k.distance_m);
    keyframe.bind(k.pose ? std::optional(k.pose->x_m) : std::nullopt);
    keyframe.bind(k.pose ? std::optional(k.pose->y_m) : std::nullopt);
    keyframe.bind(k.pose ? std::optional(k.pose->heading_rad) : std::nullopt);
    keyframe.bind(std::int64_t{k.after_gap ? 1 : 0}).execute();
    if (!k.preview_jpeg.empty()) preview.bind(id).bind(position).bind(std::span(k.preview_jpeg)).execute();
  }

  optional_tables::write(database, id, traverse);
  Statement thumbnails = database.prepare("INSERT INTO thumbnail_chunk VALUES(?,?,?,?)");
  write_chunks(thumbnails, traverse.thumbnails.pixels, traverse.thumbnails.image_size(),
               traverse.thumbnails.size(), [&](Statement& chunk) { chunk.bind(id); });
  Statement descriptor = database.prepare("INSERT INTO descriptor VALUES(?,?,?,?,?)");
  Statement chunk = database.prepare("INSERT INTO descriptor_chunk VALUES(?,?,?,?,?)");
  for (std::size_t i = 0; i < traverse.descriptors.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i);
    const Form form = form_of(traverse.descriptors[i]);
    descriptor.bind(id).bind(number).bind(form.name).bind(form.width).bind(form.height).execute();
    write_chunks(chunk, bytes_of(traverse.descriptors[i]), form.bytes, traverse.keyframes.size(),
                 [&](Statement& of) { of.bind(id).bind(number); });
  }
}

/// Throws if what takes so many bytes cannot be in the file.
void check_room(const Database& database, const std::string& path, std::string_view what, std::size_t each,
                std::size_t count) {
  if (each > 0 && count > static_cast<std::size_t>(database.allowance()) / each)
    damaged(path, fmt::format("{} are missing", what));
}

Traverse read_traverse(const Database& database, const std::string& path, std::int64_t id,
                       const RouteReadOptions& options) {
  Statement row = database.prepare(
      "SELECT name, source, frames, duration_s, frame_width_px, frame_height_px, pose_source, surveyed, "
      "keyframes, thumbnail_width, thumbnail_height FROM traverse WHERE id = ?");
  if (!row.bind(id).step()) damaged(path, fmt::format("traverse {} is missing", id));
  Traverse traverse;
  traverse.name = row.text();
  traverse.source = row.text();
  traverse.frames = row.integer();
  traverse.duration_s = row.real();
  const std::int64_t frame_width_px = row.integer(), frame_height_px = row.integer();
  traverse.pose_source = row.text();
  traverse.surveyed = row.integer() != 0;
  const std::int64_t keyframes = row.integer();
  const std::int64_t width = row.integer(), height = row.integer();
  constexpr std::int64_t kLargestSide = 1024;
  if (width < 0 || height < 0 || width > kLargestSide || height > kLargestSide)
    damaged(path, "the thumbnail size is no size");
  if (frame_width_px < 0 || frame_height_px < 0 || frame_width_px > kLargestPicture ||
      frame_height_px > kLargestPicture || traverse.frames < 0 || !std::isfinite(traverse.duration_s))
    damaged(path, "a recording's size or length is none");
  traverse.frame_width_px = static_cast<int>(frame_width_px);
  traverse.frame_height_px = static_cast<int>(frame_height_px);

  Statement settings = database.prepare("SELECT name, value FROM setting WHERE traverse = ? ORDER BY name");
  traverse.settings = read_settings(settings.bind(id), path);

  Statement keyframe = database.prepare(
      "SELECT frame, time_s, displacement, distance_m, x_m, y_m, heading_rad, after_gap FROM keyframe "
      "WHERE traverse = ? ORDER BY position");
  keyframe.bind(id);
  while (keyframe.step()) {
    Keyframe k;
    k.frame = keyframe.integer();
    k.time_s = keyframe.real();
    k.displacement = keyframe.real();
    k.distance_m = keyframe.optional_real();
    const std::optional<double> x_m = keyframe.optional_real();
    const std::optional<double> y_m = keyframe.optional_real();
    const std::optional<double> heading_rad = keyframe.optional_real();
    k.after_gap = keyframe.integer() != 0;
    if (x_m && y_m && heading_rad) k.pose = vo::Pose2{*x_m, *y_m, *heading_rad};
    traverse.keyframes.push_back(std::move(k));
  }
  if (static_cast<std::int64_t>(traverse.keyframes.size()) != keyframes)
    damaged(path, "keyframes are missing");
  if (const std::string_view problem = problem_of(traverse.keyframes); !problem.empty())
    damaged(path, problem);

  if (options.previews) {
    Statement preview = database.prepare("SELECT position, jpeg FROM preview WHERE traverse = ?");
    preview.bind(id);
    while (preview.step()) {
      const std::int64_t position = preview.integer();
      if (position < 0 || position >= keyframes) damaged(path, "a picture belongs to no keyframe");
      const std::span<const std::uint8_t> jpeg = preview.blob();
      traverse.keyframes[static_cast<std::size_t>(position)].preview_jpeg.assign(jpeg.begin(), jpeg.end());
    }
  }

  traverse.places = optional_tables::read_places(database, path, id);
  if (options.view_points)
    traverse.view_points = optional_tables::read_points(database, path, id, traverse.keyframes.size());

  if (options.previews && width > 0) {
    check_room(database, path, "thumbnails", static_cast<std::size_t>(width * height),
               traverse.keyframes.size());
    traverse.thumbnails =
        vo::make_image_stack(static_cast<int>(width), static_cast<int>(height), traverse.keyframes.size());
    Statement chunk =
        database.prepare("SELECT checksum, pixels FROM thumbnail_chunk WHERE traverse = ? ORDER BY first");
    read_chunks(chunk.bind(id), traverse.thumbnails.pixels, path, "thumbnails");
  }
  if (!options.descriptors) return traverse;
  Statement descriptor =
      database.prepare("SELECT form, width, height FROM descriptor WHERE traverse = ? ORDER BY descriptor");
  descriptor.bind(id);
  while (descriptor.step()) {
    const std::string form = descriptor.text();
    const std::int64_t first_side = descriptor.integer(), second_side = descriptor.integer();
    const std::optional<Descriptors> one = make_of_form(form, first_side, second_side, 0);
    if (!one) damaged(path, "the size of its descriptors is no size");
    check_room(database, path, "descriptors", form_of(*one).bytes, traverse.keyframes.size());
    std::optional<Descriptors> made = make_of_form(form, first_side, second_side, traverse.keyframes.size());
    Statement chunk = database.prepare(
        "SELECT checksum, bytes FROM descriptor_chunk WHERE traverse = ? AND descriptor = ? ORDER BY first");
    chunk.bind(id).bind(static_cast<std::int64_t>(traverse.descriptors.size()));
    read_chunks(chunk, bytes_of(*made), path, "descriptors");
    traverse.descriptors.push_back(std::move(*made));
  }
  return traverse;
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
  Statement row = database.prepare(
      "SELECT software_version, unit, metric, traverses, latitude_deg, longitude_deg FROM route");
  if (!row.step()) damaged(shown, "the route's row is missing");
  Route route;
  route.software_version = row.text();
  route.unit = row.real();
  route.metric = row.integer() != 0;
  const std::int64_t traverses = row.integer();
  const std::optional<double> latitude_deg = row.optional_real(), longitude_deg = row.optional_real();
  if (latitude_deg && longitude_deg) route.origin = {*latitude_deg, *longitude_deg};
  if (!(route.unit >= 0) || !std::isfinite(route.unit) ||
      (route.origin && !(std::abs(*latitude_deg) <= 90 && std::abs(*longitude_deg) <= 360)))
    damaged(shown, "the route's unit or origin is none");
  Statement settings = database.prepare("SELECT name, value FROM route_setting ORDER BY name");
  route.settings = read_settings(settings, shown);
  Statement learned = database.prepare("SELECT checksum, bytes FROM learned ORDER BY descriptor");
  while (learned.step()) {
    const std::int64_t expected = learned.integer();
    const std::span<const std::uint8_t> bytes = learned.blob();
    if (checksum(bytes) != expected) damaged(shown, "what it learned does not fit its checksum");
    route.learned.emplace_back(bytes.begin(), bytes.end());
  }
  for (std::int64_t id = 1; id <= traverses; ++id) {
    route.traverses.push_back(read_traverse(database, shown, id, options));
    if (options.descriptors && route.traverses.back().descriptors.size() != route.learned.size())
      damaged(shown, "descriptors are missing");
  }
  check_alike(route, shown);
  return route;
}

void read_previews(const std::filesystem::path& path, Route& route, std::size_t traverse,
                   std::span<const std::size_t> keyframes) {
  const Database database(path, Database::Mode::kReadOnly, path.string());
  std::vector<Keyframe>& all = route.traverses.at(traverse).keyframes;
  for (const std::size_t keyframe : keyframes) {
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

void write_route(const std::filesystem::path& path, const Route& route) {
  check(route);
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
      write_traverse(database, static_cast<std::int64_t>(i) + 1, route.traverses[i]);
    }
    row_digests::write(database);
    database.run("COMMIT");
  }
  sqlite::fold_changes(path);
  file.commit();
}

}  // namespace place
