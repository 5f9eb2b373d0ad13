#include "place/route/route_folder.hpp"

#include "place/describe/npy.hpp"
#include "place/version.hpp"
#include "route/descriptor_rows.hpp"
#include "route/route_folder_names.hpp"

#include <system_error>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/partial_path.hpp>

namespace place {
namespace {

namespace fs = std::filesystem;
using descriptor_rows::Form;
using route_folder::descriptor_file;
using route_folder::kFormat;
using route_folder::learned_file;
using route_folder::traverse_folder;

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();  // the shortest that reads back as the same
}

std::string settings_rows(std::size_t number, const Settings& settings) {
  std::string rows;
  for (const Setting& setting : settings_table()) {
    if (const auto value = text_of(settings, setting))
      rows += fmt::format("{},{},{}\n", number, setting.name, vo::csv_cell(*value));
  }
  return rows;
}

void write_descriptors(const fs::path& file, const Descriptors& descriptors) {
  const Form form = descriptor_rows::form_of(descriptors);
  if (const auto* floats = std::get_if<FloatRows>(&descriptors)) {
    write_npy(file, *floats);
  } else if (const auto* columns = std::get_if<ColumnStack>(&descriptors)) {
    write_npy(file, std::span<const std::int8_t>(columns->values), form.bytes);
  } else {
    write_npy(file, std::get<vo::ImageStack>(descriptors).pixels, form.bytes);
  }
}

void write_traverse(const fs::path& folder, const Traverse& traverse) {
  fs::create_directory(folder);
  std::string rows =
      "frame,time_s,displacement,distance_m,x_m,y_m,heading_rad,after_gap,preview,points_bytes\n";
  Bytes points;
  for (std::size_t i = 0; i < traverse.keyframes.size(); ++i) {
    const Keyframe& k = traverse.keyframes[i];
    const auto of_pose = [&](double vo::Pose2::*member) {
      return number(k.pose ? std::optional(k.pose.value().*member) : std::nullopt);
    };
    std::string preview, size;
    if (!k.preview_jpeg.empty()) {
      preview = fmt::format("preview-{:06}.jpg", k.frame);
      vo::write_file(folder / preview,
                     {reinterpret_cast<const char*>(k.preview_jpeg.data()), k.preview_jpeg.size()});
    }
    if (!traverse.view_points.empty()) {
      size = fmt::format("{}", traverse.view_points[i].size());
      points.insert(points.end(), traverse.view_points[i].begin(), traverse.view_points[i].end());
    }
    rows += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", k.frame, number(k.time_s), number(k.displacement),
                        number(k.distance_m), of_pose(&vo::Pose2::x_m), of_pose(&vo::Pose2::y_m),
                        of_pose(&vo::Pose2::heading_rad), k.after_gap ? 1 : 0, preview, size);
  }
  vo::write_file(folder / "keyframes.csv", rows);
  if (!traverse.view_points.empty()) write_npy(folder / "points.npy", points, 1);
  if (traverse.thumbnails.image_size() > 0)
    write_npy(folder / "thumbnails.npy", traverse.thumbnails.pixels, traverse.thumbnails.image_size());
  for (std::size_t d = 0; d < traverse.descriptors.size(); ++d)
    write_descriptors(descriptor_file(folder, d), traverse.descriptors[d]);
}

/// Only where there are any.
void write_places(const fs::path& folder, const Traverse& traverse) {
  if (traverse.places.empty()) return;
  std::string rows = "frame,distance_m,name\n";
  for (const NamedPlace& place : traverse.places)
    rows += fmt::format("{},{},{}\n", place.frame, number(place.distance_m), vo::csv_cell(place.name));
  vo::write_file(folder / "places.csv", rows);
}

void write_all(const fs::path& folder, const Route& route) {
  std::string values = fmt::format("name,value\nformat,{}\nwritten_by,{}\nunit,{}\nmetric,{}\n", kFormat,
                                   vo::csv_cell(kVersion), number(route.unit), route.metric ? 1 : 0);
  if (route.origin)
    values += fmt::format("latitude_deg,{}\nlongitude_deg,{}\n", number(route.origin->latitude_deg),
                          number(route.origin->longitude_deg));
  vo::write_file(folder / "route.csv", values);

  std::string settings = "traverse,name,value\n" + settings_rows(0, route.settings);
  std::string traverses =
      "traverse,name,source,frames,duration_s,frame_width_px,frame_height_px,pose_source,surveyed,"
      "thumbnail_width,thumbnail_height\n";
  for (std::size_t t = 0; t < route.traverses.size(); ++t) {
    const Traverse& traverse = route.traverses[t];
    settings += settings_rows(t + 1, traverse.settings);
    traverses +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", t + 1, vo::csv_cell(traverse.name),
                    vo::csv_cell(traverse.source), traverse.frames, number(traverse.duration_s),
                    traverse.frame_width_px, traverse.frame_height_px, vo::csv_cell(traverse.pose_source),
                    traverse.surveyed ? 1 : 0, traverse.thumbnails.width, traverse.thumbnails.height);
    write_traverse(traverse_folder(folder, t), traverse);
    write_places(traverse_folder(folder, t), traverse);
  }
  vo::write_file(folder / "settings.csv", settings);
  vo::write_file(folder / "traverses.csv", traverses);

  std::string descriptors = "descriptor,form,width,height\n";
  for (std::size_t d = 0; d < route.learned.size(); ++d) {
    if (!route.traverses.empty()) {
      const Form form = descriptor_rows::form_of(route.traverses.front().descriptors.at(d));
      descriptors += fmt::format("{},{},{},{}\n", d + 1, form.name, form.width, form.height);
    }
    write_npy(learned_file(folder, d), route.learned[d], 1);
  }
  vo::write_file(folder / "descriptors.csv", descriptors);
}

}  // namespace

void write_route_folder(const fs::path& folder, const Route& route) {
  const fs::path path = folder.has_filename() ? folder : folder.parent_path();  // "folder/"
  std::error_code error;
  if (fs::exists(path, error) && !(fs::is_directory(path, error) && fs::is_empty(path, error)))
    throw vo::Error(path.string(), "is there already", "a new folder");
  vo::remove_abandoned(path);
  vo::PartialPath partial(vo::partial_name(path));
  fs::create_directories(partial.path(), error);
  if (error) throw vo::Error(path.string(), "cannot be made: " + error.message(), "a writable folder");
  try {
    write_all(partial.path(), route);
  } catch (const fs::filesystem_error& failed) {
    throw vo::Error(path.string(), "cannot be written: " + failed.code().message(), "a writable folder");
  }
  if (const int failed = partial.rename_to(path); failed != 0)
    throw vo::Error(path.string(), "cannot be written: " + std::generic_category().message(failed),
                    "a writable folder");
}

}  // namespace place
