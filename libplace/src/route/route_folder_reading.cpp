#include "place/describe/npy.hpp"
#include "place/route/route_folder.hpp"
#include "place/version.hpp"
#include "route/descriptor_rows.hpp"
#include "route/keyframe_check.hpp"
#include "route/route_folder_names.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace place {
namespace {

namespace fs = std::filesystem;
using descriptor_rows::Form;
using route_folder::descriptor_file;
using route_folder::kFormat;
using route_folder::learned_file;
using route_folder::traverse_folder;
using vo::CsvTable;

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw vo::Error(path.string(), "cannot be read", "a file of a route's folder");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Bytes as they were written: every value of an array read back is one.
template <typename Byte>
void bytes_from(const fs::path& file, std::size_t rows, std::size_t width, std::span<Byte> bytes) {
  const FloatRows read = read_npy(file);
  if (read.width != width || read.size() != rows) {
    throw vo::Error(file.string(), fmt::format("is of {} x {}", read.size(), read.width),
                    fmt::format("{} x {}, a row for each keyframe", rows, width));
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const float value = read.values[i];
    const bool whole = value >= std::numeric_limits<Byte>::min() &&
                       value <= std::numeric_limits<Byte>::max() && value == std::trunc(value);
    if (!whole)
      throw vo::Error(file.string(), fmt::format("holds {}", value),
                      std::numeric_limits<Byte>::is_signed ? "int8" : "uint8");
    bytes[i] = static_cast<Byte>(value);
  }
}

Bytes all_bytes(const fs::path& file) {
  Bytes bytes(read_npy(file).size());
  bytes_from<std::uint8_t>(file, bytes.size(), 1, bytes);
  return bytes;
}

Descriptors read_descriptors(const fs::path& file, const Form& form, std::size_t count) {
  std::optional<Descriptors> made = descriptor_rows::make_of_form(form.name, form.width, form.height, count);
  if (!made)
    throw vo::Error((file.parent_path().parent_path() / "descriptors.csv").string(),
                    fmt::format("has a form '{}' of {} x {}", form.name, form.width, form.height),
                    "pixels, columns or floats, and their sizes");
  const std::size_t width = static_cast<std::size_t>(form.width * form.height);
  if (auto* floats = std::get_if<FloatRows>(&*made)) {
    FloatRows read = read_npy(file);
    if (read.width != width || read.size() != count)
      throw vo::Error(file.string(), fmt::format("is of {} x {}", read.size(), read.width),
                      fmt::format("{} x {}, a row for each keyframe", count, width));
    *floats = std::move(read);
  } else if (auto* columns = std::get_if<ColumnStack>(&*made)) {
    bytes_from<std::int8_t>(file, count, width, columns->values);
  } else {
    bytes_from<std::uint8_t>(file, count, width, std::get<vo::ImageStack>(*made).pixels);
  }
  return std::move(*made);
}

void read_keyframes(const fs::path& folder, Traverse& traverse) {
  const CsvTable table = CsvTable::read(folder / "keyframes.csv");
  const auto frames = table.indices("frame"), gaps = table.indices("after_gap");
  const auto times = table.numbers("time_s"), displacements = table.numbers("displacement");
  const auto distances = table.optional_numbers("distance_m"), x = table.optional_numbers("x_m"),
             y = table.optional_numbers("y_m"), headings = table.optional_numbers("heading_rad");
  const auto previews = table.text("preview");
  const auto sizes = table.optional_indices("points_bytes");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (i > 0 && frames[i] <= frames[i - 1])
      throw vo::Error(table.where(i), fmt::format("has frame {} after {}", frames[i], frames[i - 1]),
                      "keyframes in order");
    if (i > 0 && times[i] < times[i - 1])
      throw vo::Error(table.where(i), fmt::format("has time_s {} after {}", times[i], times[i - 1]),
                      "keyframes in order");
    if (i == 0 && gaps[i] != 0)
      throw vo::Error(table.where(i), "is after a gap", "one between two keyframes");
    Keyframe k{.frame = frames[i],
               .time_s = times[i],
               .displacement = displacements[i],
               .distance_m = distances[i],
               .pose = {},
               .after_gap = gaps[i] != 0,
               .preview_jpeg = {}};
    if (x[i] && y[i] && headings[i]) k.pose = vo::Pose2{*x[i], *y[i], *headings[i]};
    if (!previews[i].empty()) {
      const std::string jpeg = text_of_file(folder / fs::path(previews[i]).filename());
      k.preview_jpeg.assign(jpeg.begin(), jpeg.end());
    }
    traverse.keyframes.push_back(std::move(k));
  }
  if (!fs::exists(folder / "points.npy")) return;
  const Bytes points = all_bytes(folder / "points.npy");
  std::size_t at = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto size = static_cast<std::size_t>(sizes[i].value_or(0));
    if (size > points.size() - at)
      throw vo::Error((folder / "points.npy").string(), fmt::format("has {} bytes", points.size()),
                      "as many as points_bytes in keyframes.csv");
    traverse.view_points.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(at),
                                      points.begin() + static_cast<std::ptrdiff_t>(at + size));
    at += size;
  }
}

void read_places(const fs::path& file, Traverse& traverse) {
  if (!fs::exists(file)) return;
  const CsvTable table = CsvTable::read(file);
  const auto frames = table.indices("frame");
  const auto distances = table.optional_numbers("distance_m");
  const auto names = table.text("name");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (names[i].empty()) throw vo::Error(table.where(i), "has no name", "a name for each place");
    traverse.places.push_back({names[i], frames[i], distances[i]});
  }
  std::ranges::stable_sort(traverse.places, {}, &NamedPlace::frame);
}

std::vector<Settings> read_settings(const fs::path& folder, std::size_t traverses) {
  const CsvTable table = CsvTable::read(folder / "settings.csv");
  std::vector<Settings> settings(traverses + 1);
  const auto of = table.indices("traverse");
  const auto names = table.text("name"), values = table.text("value");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (of[i] > static_cast<std::int64_t>(traverses))
      throw vo::Error(table.where(i), fmt::format("is of traverse {}", of[i]),
                      fmt::format("0 to {}", traverses));
    try {
      set(settings[static_cast<std::size_t>(of[i])], setting_named(names[i]), values[i]);
    } catch (const vo::Error& error) {
      throw vo::Error(table.where(i), error.what());
    }
  }
  return settings;
}

void read_values(const fs::path& folder, Route& route) {
  const CsvTable table = CsvTable::read(folder / "route.csv");
  const auto names = table.text("name"), values = table.text("value");
  const auto value = [&](std::string_view name, bool needed) -> std::optional<double> {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != name) continue;
      if (const auto parsed = vo::parse_number(values[i])) return parsed;
      throw vo::Error(table.where(i), fmt::format("{} is '{}'", name, values[i]), "a number");
    }
    if (needed)
      throw vo::Error((folder / "route.csv").string(), fmt::format("has no '{}'", name),
                      "a folder written by `retrace inspect --export`");
    return std::nullopt;
  };
  if (value("format", true) != kFormat)
    throw vo::Error((folder / "route.csv").string(), "is of another format",
                    fmt::format("format {}", kFormat));
  route.unit = *value("unit", true);
  route.metric = *value("metric", true) != 0;
  const auto latitude = value("latitude_deg", false), longitude = value("longitude_deg", false);
  if (latitude && longitude) route.origin = GeographicOrigin{*latitude, *longitude};
  const bool on_earth = !route.origin || (std::abs(*latitude) <= 90 && std::abs(*longitude) <= 360);
  if (!(route.unit >= 0) || !on_earth)
    throw vo::Error((folder / "route.csv").string(), "has a unit or an origin that is none",
                    "unit from 0, latitude_deg within 90, longitude_deg within 360");
}

Traverse read_traverse(const fs::path& folder, const CsvTable& table, std::size_t row,
                       const std::vector<Form>& forms) {
  const auto whole = [&](const char* column) { return table.indices(column)[row]; };
  Traverse traverse;
  traverse.name = table.text("name")[row];
  traverse.source = table.text("source")[row];
  traverse.frames = whole("frames");
  traverse.duration_s = table.numbers("duration_s")[row];
  if (whole("frame_width_px") > kLargestPicture || whole("frame_height_px") > kLargestPicture)
    throw vo::Error(table.where(row), "has pictures of no size", "frame_width_px and frame_height_px");
  traverse.frame_width_px = static_cast<int>(whole("frame_width_px"));
  traverse.frame_height_px = static_cast<int>(whole("frame_height_px"));
  traverse.pose_source = table.text("pose_source")[row];
  traverse.surveyed = whole("surveyed") != 0;
  read_keyframes(folder, traverse);
  read_places(folder / "places.csv", traverse);
  const std::size_t count = traverse.keyframes.size();
  if (fs::exists(folder / "thumbnails.npy")) {
    const std::int64_t width = whole("thumbnail_width"), height = whole("thumbnail_height");
    constexpr std::int64_t kLargestSide = 1024;  // as in a route's database
    if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
      throw vo::Error(table.where(row), "has thumbnails of no size", "thumbnail_width and thumbnail_height");
    traverse.thumbnails = vo::make_image_stack(static_cast<int>(width), static_cast<int>(height), count);
    bytes_from<std::uint8_t>(folder / "thumbnails.npy", count, traverse.thumbnails.image_size(),
                             traverse.thumbnails.pixels);
  }
  for (std::size_t d = 0; d < forms.size(); ++d)
    traverse.descriptors.push_back(read_descriptors(descriptor_file(folder, d), forms[d], count));
  return traverse;
}

}  // namespace

Route read_route_folder(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw vo::Error(folder.string(), "is no folder", "one written by `retrace inspect --export`");
  if (!fs::exists(folder / "route.csv"))
    throw vo::Error(folder.string(), "holds no route.csv", "a folder written by `retrace inspect --export`");
  Route route;
  read_values(folder, route);
  route.software_version = kVersion;
  const CsvTable table = CsvTable::read(folder / "traverses.csv");
  const CsvTable descriptors = CsvTable::read(folder / "descriptors.csv");
  const std::vector<std::string> names = descriptors.text("form");
  const auto widths = descriptors.indices("width"), heights = descriptors.indices("height");
  std::vector<Form> forms;
  for (std::size_t d = 0; d < descriptors.rows(); ++d)
    forms.push_back({.name = names[d], .width = widths[d], .height = heights[d]});
  for (std::size_t d = 0; fs::exists(learned_file(folder, d)); ++d)
    route.learned.push_back(all_bytes(learned_file(folder, d)));
  if (table.rows() > 0 && route.learned.size() != forms.size())
    throw vo::Error((folder / "descriptors.csv").string(), fmt::format("names {} descriptors", forms.size()),
                    fmt::format("{}, one for each learned-D.npy", route.learned.size()));
  std::vector<Settings> settings = read_settings(folder, table.rows());
  route.settings = std::move(settings[0]);
  std::set<std::string> taken;
  for (std::size_t t = 0; t < table.rows(); ++t) {
    Traverse traverse = read_traverse(traverse_folder(folder, t), table, t, forms);
    traverse.settings = std::move(settings[t + 1]);
    if (!taken.insert(traverse.name).second)
      throw vo::Error(table.where(t), fmt::format("names '{}' again", traverse.name), "one name for each");
    route.traverses.push_back(std::move(traverse));
  }
  return route;
}

}  // namespace place
