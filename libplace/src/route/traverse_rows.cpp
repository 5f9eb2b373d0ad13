#include "route/traverse_rows.hpp"

#include "route/descriptor_rows.hpp"
#include "route/keyframe_check.hpp"
#include "route/optional_tables.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place::traverse_rows {
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

/// Throws if what takes so many bytes cannot be in the file.
void check_room(const Database& database, const std::string& path, std::string_view what, std::size_t each,
                std::size_t count) {
  if (each > 0 && count > static_cast<std::size_t>(database.allowance()) / each)
    damaged(path, fmt::format("{} are missing", what));
}

}  // namespace

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

void write(const Database& database, std::int64_t id, const Traverse& traverse) {
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

Traverse read(const Database& database, const std::string& path, std::int64_t id,
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

}  // namespace place::traverse_rows
