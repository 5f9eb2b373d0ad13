#include "place/route/route_database.hpp"

#include "place/version.hpp"
#include "route/sqlite.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace place {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr std::int64_t kApplicationId = 0x72747263;  // "rtrc", in the header of the file
constexpr std::size_t kChunkThumbnails = 256;

// What walks take over lies as key and value, so that a new setting changes no table.
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
CREATE TABLE setting(
  traverse INTEGER NOT NULL REFERENCES traverse, name TEXT NOT NULL, value TEXT NOT NULL,
  PRIMARY KEY(traverse, name)) WITHOUT ROWID;
CREATE TABLE keyframe(
  traverse INTEGER NOT NULL REFERENCES traverse, position INTEGER NOT NULL,
  frame INTEGER NOT NULL, time_s REAL NOT NULL, displacement REAL NOT NULL,
  distance_m REAL, x_m REAL, y_m REAL, heading_rad REAL, PRIMARY KEY(traverse, position)) WITHOUT ROWID;
CREATE TABLE thumbnail_chunk(
  traverse INTEGER NOT NULL REFERENCES traverse, first INTEGER NOT NULL, checksum INTEGER NOT NULL,
  pixels BLOB NOT NULL, PRIMARY KEY(traverse, first));
CREATE TABLE preview(
  traverse INTEGER NOT NULL REFERENCES traverse, position INTEGER NOT NULL, jpeg BLOB NOT NULL,
  PRIMARY KEY(traverse, position));
)sql";

/// FNV-1a over 64-bit words, the last one filled up with zeros.
std::int64_t checksum(std::span<const std::uint8_t> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    hash = (hash ^ word) * 0x100000001b3U;
  }
  return std::bit_cast<std::int64_t>(hash);
}

[[noreturn]] void damaged(const std::string& path, std::string_view what) {
  throw vo::Error(path, fmt::format("is damaged: {}", what), "a whole route database; build it again");
}

void check(const Route& route) {
  std::set<std::string> names;
  for (const Traverse& traverse : route.traverses) {
    if (!names.insert(traverse.name).second)
      throw std::invalid_argument("write_route: two traverses share a name");
    if (traverse.thumbnails.size() != traverse.keyframes.size() ||
        traverse.thumbnails.width != route.traverses.front().thumbnails.width ||
        traverse.thumbnails.height != route.traverses.front().thumbnails.height) {
      throw std::invalid_argument(
          "write_route: a traverse's thumbnails do not fit its keyframes or the other traverses'");
    }
  }
}

/// The settings that a statement gives as name and value.
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

  Statement keyframe = database.prepare("INSERT INTO keyframe VALUES(?,?,?,?,?,?,?,?,?)");
  Statement preview = database.prepare("INSERT INTO preview VALUES(?,?,?)");
  for (std::size_t i = 0; i < traverse.keyframes.size(); ++i) {
    const Keyframe& k = traverse.keyframes[i];
    const auto position = static_cast<std::int64_t>(i);
    keyframe.bind(id).bind(position).bind(k.frame).bind(k.time_s).bind(k.displacement).bind(k.distance_m);
    keyframe.bind(k.pose ? std::optional(k.pose->x_m) : std::nullopt);
    keyframe.bind(k.pose ? std::optional(k.pose->y_m) : std::nullopt);
    keyframe.bind(k.pose ? std::optional(k.pose->heading_rad) : std::nullopt).execute();
    if (!k.preview_jpeg.empty()) preview.bind(id).bind(position).bind(std::span(k.preview_jpeg)).execute();
  }

  Statement chunk = database.prepare("INSERT INTO thumbnail_chunk VALUES(?,?,?,?)");
  const std::size_t size = traverse.thumbnails.image_size();
  const std::span<const std::uint8_t> pixels = traverse.thumbnails.pixels;
  for (std::size_t first = 0; first < traverse.keyframes.size(); first += kChunkThumbnails) {
    const std::size_t count = std::min(kChunkThumbnails, traverse.keyframes.size() - first);
    const std::span<const std::uint8_t> part = pixels.subspan(first * size, count * size);
    chunk.bind(id).bind(static_cast<std::int64_t>(first)).bind(checksum(part)).bind(part).execute();
  }
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
  traverse.frame_width_px = static_cast<int>(row.integer());
  traverse.frame_height_px = static_cast<int>(row.integer());
  traverse.pose_source = row.text();
  traverse.surveyed = row.integer() != 0;
  const std::int64_t keyframes = row.integer();
  const std::int64_t width = row.integer(), height = row.integer();
  constexpr std::int64_t kLargestSide = 1024;
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    damaged(path, "the thumbnail size is no size");

  Statement settings = database.prepare("SELECT name, value FROM setting WHERE traverse = ? ORDER BY name");
  traverse.settings = read_settings(settings.bind(id), path);

  Statement keyframe = database.prepare(
      "SELECT frame, time_s, displacement, distance_m, x_m, y_m, heading_rad FROM keyframe WHERE traverse = "
      "? "
      "ORDER BY position");
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
    if (x_m && y_m && heading_rad) k.pose = vo::Pose2{*x_m, *y_m, *heading_rad};
    traverse.keyframes.push_back(std::move(k));
  }
  if (static_cast<std::int64_t>(traverse.keyframes.size()) != keyframes)
    damaged(path, "keyframes are missing");

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

  traverse.thumbnails =
      vo::make_image_stack(static_cast<int>(width), static_cast<int>(height), traverse.keyframes.size());
  std::span<std::uint8_t> missing = traverse.thumbnails.pixels;
  Statement chunk =
      database.prepare("SELECT checksum, pixels FROM thumbnail_chunk WHERE traverse = ? ORDER BY first");
  chunk.bind(id);
  while (chunk.step()) {
    const std::int64_t expected = chunk.integer();
    const std::span<const std::uint8_t> part = chunk.blob();
    if (checksum(part) != expected) damaged(path, "a block of thumbnails does not fit its checksum");
    if (part.size() > missing.size()) damaged(path, "there are more thumbnails than keyframes");
    std::ranges::copy(part, missing.begin());
    missing = missing.subspan(part.size());
  }
  if (!missing.empty()) damaged(path, "thumbnails are missing");
  return traverse;
}

}  // namespace

bool has_poses(const Route& route) {
  return std::ranges::any_of(route.traverses, [](const Traverse& traverse) {
    return std::ranges::any_of(traverse.keyframes,
                               [](const Keyframe& keyframe) { return keyframe.pose.has_value(); });
  });
}

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

  // SQLite fills a last page that is cut short with zeros.
  Statement size = database.prepare("SELECT page_count * page_size FROM pragma_page_count, pragma_page_size");
  if (!size.step() || size.integer() != static_cast<std::int64_t>(std::filesystem::file_size(path))) {
    damaged(shown, "it is cut short");
  }

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
  Statement settings = database.prepare("SELECT name, value FROM route_setting ORDER BY name");
  route.settings = read_settings(settings, shown);
  for (std::int64_t id = 1; id <= traverses; ++id)
    route.traverses.push_back(read_traverse(database, shown, id, options));
  return route;
}

void write_route(const std::filesystem::path& path, const Route& route) {
  check(route);
  if (std::filesystem::is_directory(path)) throw vo::Error(path.string(), "is a folder", "a file to write");
  vo::AtomicFile file(path);
  std::error_code ignored;
  std::filesystem::remove(file.temporary(), ignored);  // of a killed process that had the same number
  {
    const Database database(file.temporary(), Database::Mode::kCreate, path.string());
    // No journal: until the rename nobody looks at this file, and a broken one is thrown away whole.
    // Pages of 16 kB: a quarter of the reads that thumbnails take with SQLite's usual 4 kB.
    database.run("PRAGMA page_size = 16384; PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;");
    database.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kApplicationId,
                             kRouteSchemaVersion));
    database.run("BEGIN");
    database.run(kSchema);
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
    for (std::size_t i = 0; i < route.traverses.size(); ++i) {
      write_traverse(database, static_cast<std::int64_t>(i) + 1, route.traverses[i]);
    }
    database.run("COMMIT");
  }
  file.commit();
}

}  // namespace place
