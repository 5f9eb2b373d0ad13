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

constexpr const char* kSchema = R"sql(
CREATE TABLE route(
  software_version TEXT NOT NULL,
  thumbnail_width INTEGER NOT NULL, thumbnail_height INTEGER NOT NULL,
  patch_px INTEGER NOT NULL, patch_shape TEXT NOT NULL, patch_min_deviation REAL NOT NULL,
  patch_min_contrast REAL NOT NULL,
  motion TEXT NOT NULL, every INTEGER NOT NULL, sampling_n REAL NOT NULL, sampling_unit REAL NOT NULL,
  traverses INTEGER NOT NULL, metric INTEGER NOT NULL);
CREATE TABLE traverse(
  id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, source TEXT NOT NULL,
  frames INTEGER NOT NULL, duration_s REAL NOT NULL, frame_width_px INTEGER NOT NULL, frame_height_px INTEGER NOT NULL,
  pose_source TEXT NOT NULL, keyframes INTEGER NOT NULL, motion_knots INTEGER NOT NULL,
  surveyed INTEGER NOT NULL);
CREATE TABLE geographic_origin(latitude_deg REAL NOT NULL, longitude_deg REAL NOT NULL);
CREATE TABLE setting(
  traverse INTEGER NOT NULL REFERENCES traverse, name TEXT NOT NULL, value TEXT NOT NULL,
  PRIMARY KEY(traverse, name)) WITHOUT ROWID;
CREATE TABLE motion_knot(
  traverse INTEGER NOT NULL REFERENCES traverse, position INTEGER NOT NULL,
  error REAL NOT NULL, separation REAL NOT NULL, PRIMARY KEY(traverse, position)) WITHOUT ROWID;
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

std::optional<vo::MotionSource> motion_source(std::string_view name) {
  using enum vo::MotionSource;
  for (const vo::MotionSource motion : {kNone, kSad, kSteps, kVisualOdometry, kHybrid, kFile}) {
    if (name == vo::name_of(motion)) return motion;
  }
  return std::nullopt;
}

std::string_view name_of(vo::PatchShape shape) {
  return shape == vo::PatchShape::kGrid ? "grid" : "window";
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
        traverse.thumbnails.width != route.thumbnail.width ||
        traverse.thumbnails.height != route.thumbnail.height) {
      throw std::invalid_argument(
          "write_route: a traverse's thumbnails do not fit its keyframes or the route");
    }
  }
}

void write_traverse(const Database& database, std::int64_t id, const Traverse& traverse) {
  database.prepare("INSERT INTO traverse VALUES(?,?,?,?,?,?,?,?,?,?,?)")
      .bind(id)
      .bind(traverse.name)
      .bind(traverse.source)
      .bind(traverse.frames)
      .bind(traverse.duration_s)
      .bind(std::int64_t{traverse.frame_width_px})
      .bind(std::int64_t{traverse.frame_height_px})
      .bind(traverse.pose_source)
      .bind(static_cast<std::int64_t>(traverse.keyframes.size()))
      .bind(static_cast<std::int64_t>(traverse.motion_model.error.size()))
      .bind(std::int64_t{traverse.surveyed ? 1 : 0})
      .execute();

  Statement setting = database.prepare("INSERT INTO setting VALUES(?,?,?)");
  for (const auto& [name, value] : traverse.settings) setting.bind(id).bind(name).bind(value).execute();

  Statement knot = database.prepare("INSERT INTO motion_knot VALUES(?,?,?,?)");
  for (std::size_t i = 0; i < traverse.motion_model.error.size(); ++i) {
    knot.bind(id).bind(static_cast<std::int64_t>(i));
    knot.bind(traverse.motion_model.error[i]).bind(traverse.motion_model.separation[i]).execute();
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

Traverse read_traverse(const Database& database, const std::string& path, std::int64_t id, const Route& route,
                       const RouteReadOptions& options) {
  Statement row = database.prepare(
      "SELECT name, source, frames, duration_s, frame_width_px, frame_height_px, pose_source, keyframes, "
      "motion_knots "
      "FROM traverse WHERE id = ?");
  if (!row.bind(id).step()) damaged(path, fmt::format("traverse {} is missing", id));
  Traverse traverse;
  traverse.name = row.text();
  traverse.source = row.text();
  traverse.frames = row.integer();
  traverse.duration_s = row.real();
  traverse.frame_width_px = static_cast<int>(row.integer());
  traverse.frame_height_px = static_cast<int>(row.integer());
  traverse.pose_source = row.text();
  const std::int64_t keyframes = row.integer();
  const std::int64_t knots = row.integer();

  Statement setting = database.prepare("SELECT name, value FROM setting WHERE traverse = ? ORDER BY name");
  setting.bind(id);
  while (setting.step()) {
    std::string name = setting.text();
    traverse.settings[std::move(name)] = setting.text();
  }

  Statement knot =
      database.prepare("SELECT error, separation FROM motion_knot WHERE traverse = ? ORDER BY position");
  knot.bind(id);
  while (knot.step()) {
    traverse.motion_model.error.push_back(knot.real());
    traverse.motion_model.separation.push_back(knot.real());
  }
  if (static_cast<std::int64_t>(traverse.motion_model.error.size()) != knots)
    damaged(path, "motion knots are missing");

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
      vo::make_image_stack(route.thumbnail.width, route.thumbnail.height, traverse.keyframes.size());
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

/// What files of schema 1 have not.
void read_additions_of_schema_2(const Database& database, Route& route) {
  Statement metric = database.prepare("SELECT metric FROM route");
  if (metric.step()) route.sampling.metric = metric.integer() != 0;
  Statement surveyed = database.prepare("SELECT surveyed FROM traverse ORDER BY id");
  for (Traverse& traverse : route.traverses) {
    if (surveyed.step()) traverse.surveyed = surveyed.integer() != 0;
  }
  Statement origin = database.prepare("SELECT latitude_deg, longitude_deg FROM geographic_origin");
  if (!origin.step()) return;
  route.origin.emplace();
  route.origin->latitude_deg = origin.real();
  route.origin->longitude_deg = origin.real();
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
  if (schema > kRouteSchemaVersion) {
    throw vo::Error(shown, fmt::format("has schema version {}, written by a newer retrace", schema),
                    fmt::format("schema version {} or older; update retrace", kRouteSchemaVersion));
  }

  // SQLite fills a last page that is cut short with zeros.
  Statement size = database.prepare("SELECT page_count * page_size FROM pragma_page_count, pragma_page_size");
  if (!size.step() || size.integer() != static_cast<std::int64_t>(std::filesystem::file_size(path))) {
    damaged(shown, "it is cut short");
  }

  Statement row = database.prepare(
      "SELECT software_version, thumbnail_width, thumbnail_height, patch_px, patch_shape, "
      "patch_min_deviation, patch_min_contrast, motion, "
      "every, sampling_n, sampling_unit, traverses FROM route");
  if (!row.step()) damaged(shown, "the route's row is missing");
  Route route;
  route.software_version = row.text();
  route.thumbnail.width = static_cast<int>(row.integer());
  route.thumbnail.height = static_cast<int>(row.integer());
  route.patch.patch_px = static_cast<int>(row.integer());
  route.patch.shape =
      row.text() == name_of(vo::PatchShape::kWindow) ? vo::PatchShape::kWindow : vo::PatchShape::kGrid;
  route.patch.min_deviation = row.real();
  route.patch.min_contrast = row.real();
  const std::optional<vo::MotionSource> motion = motion_source(row.text());
  if (!motion) damaged(shown, "its motion source is unknown");
  route.sampling.motion = *motion;
  route.sampling.metric = *motion == vo::MotionSource::kSteps;  // of schema 1 the only metric source
  route.sampling.every = static_cast<int>(row.integer());
  route.sampling.n = row.real();
  route.sampling.unit = row.real();
  if (route.thumbnail.width < 1 || route.thumbnail.height < 1)
    damaged(shown, "the thumbnail size is no size");
  const std::int64_t traverses = row.integer();
  for (std::int64_t id = 1; id <= traverses; ++id) {
    route.traverses.push_back(read_traverse(database, shown, id, route, options));
  }
  if (schema >= 2) read_additions_of_schema_2(database, route);
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
    database.prepare("INSERT INTO route VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?)")
        .bind(std::string_view(kVersion))
        .bind(std::int64_t{route.thumbnail.width})
        .bind(std::int64_t{route.thumbnail.height})
        .bind(std::int64_t{route.patch.patch_px})
        .bind(name_of(route.patch.shape))
        .bind(route.patch.min_deviation)
        .bind(route.patch.min_contrast)
        .bind(vo::name_of(route.sampling.motion))
        .bind(std::int64_t{route.sampling.every})
        .bind(route.sampling.n)
        .bind(route.sampling.unit)
        .bind(static_cast<std::int64_t>(route.traverses.size()))
        .bind(std::int64_t{route.sampling.metric ? 1 : 0})
        .execute();
    if (route.origin) {
      database.prepare("INSERT INTO geographic_origin VALUES(?,?)")
          .bind(route.origin->latitude_deg)
          .bind(route.origin->longitude_deg)
          .execute();
    }
    for (std::size_t i = 0; i < route.traverses.size(); ++i) {
      write_traverse(database, static_cast<std::int64_t>(i) + 1, route.traverses[i]);
    }
    database.run("COMMIT");
  }
  file.commit();
}

}  // namespace place
