#include "route_contents.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/route/route_database.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

ordered_json settings_json(const place::Settings& settings) {
  ordered_json json = ordered_json::object();
  for (const place::Setting& setting : place::settings_table()) {
    const std::optional<std::string> value = place::text_of(settings, setting);
    if (value) json[std::string(setting.name)] = *value;
  }
  return json;
}

/// Bytes of the descriptors of one keyframe.
std::size_t descriptor_bytes(const place::Traverse& traverse) {
  std::size_t bytes = 0;
  for (const place::Descriptors& descriptors : traverse.descriptors)
    bytes += place::bytes_of_each(descriptors);
  return bytes;
}

std::string settings_text(const place::Settings& settings) {
  std::string text;
  for (const place::Setting& setting : place::settings_table()) {
    if (const auto value = place::text_of(settings, setting))
      text += fmt::format(" {}={}", setting.name, *value);
  }
  return text;
}

}  // namespace

nlohmann::ordered_json route_json(const std::string& path, const place::Route& route) {
  ordered_json json{{"route", path},
                    {"bytes", std::filesystem::file_size(path)},
                    {"schema_version", place::kRouteSchemaVersion},
                    {"software_version", route.software_version},
                    {"settings", settings_json(route.settings)},
                    {"unit", route.unit},
                    {"metric", route.metric},
                    {"traverses", ordered_json::array()}};
  for (const place::Traverse& traverse : route.traverses) {
    std::size_t poses = 0, previews = 0;
    ordered_json keyframes = ordered_json::array();
    for (const place::Keyframe& keyframe : traverse.keyframes) {
      poses += keyframe.pose ? 1 : 0;
      previews += keyframe.preview_jpeg.empty() ? 0 : 1;
      ordered_json k{
          {"frame", keyframe.frame}, {"time_s", keyframe.time_s}, {"displacement", keyframe.displacement}};
      if (keyframe.distance_m) k["distance_m"] = *keyframe.distance_m;
      if (keyframe.pose) {
        k["x_m"] = keyframe.pose->x_m;
        k["y_m"] = keyframe.pose->y_m;
        k["heading_rad"] = keyframe.pose->heading_rad;
      }
      if (keyframe.after_gap) k["after_gap"] = true;
      keyframes.push_back(std::move(k));
    }
    ordered_json places = ordered_json::array();
    for (const place::NamedPlace& named : traverse.places) {
      places.push_back({{"name", named.name}, {"frame", named.frame}});
      if (named.distance_m) places.back()["distance_m"] = *named.distance_m;
    }
    json["traverses"].push_back({{"name", traverse.name},
                                 {"source", traverse.source},
                                 {"frames", traverse.frames},
                                 {"duration_s", traverse.duration_s},
                                 {"frame_size", {traverse.frame_width_px, traverse.frame_height_px}},
                                 {"pose_source", traverse.pose_source},
                                 {"surveyed", traverse.surveyed},
                                 {"keyframes", traverse.keyframes.size()},
                                 {"descriptor_bytes", descriptor_bytes(traverse)},
                                 {"poses", poses},
                                 {"previews", previews},
                                 {"places", std::move(places)},
                                 {"settings", settings_json(traverse.settings)},
                                 {"keyframe", std::move(keyframes)}});
  }
  return json;
}

void print_route(const std::string& path, const place::Route& route) {
  fmt::print("{}: {:.2f} MB, schema {}, written by retrace {}\n", path,
             static_cast<double>(std::filesystem::file_size(path)) / 1e6, place::kRouteSchemaVersion,
             route.software_version);
  if (route.unit > 0)
    fmt::print("keyframes {:.4f} {} apart\n", route.unit, route.metric ? "m" : "frames of mean speed");
  fmt::print("settings:{}\n", settings_text(route.settings));
  for (const place::Traverse& traverse : route.traverses) {
    fmt::print("\ntraverse '{}' from {}\n", traverse.name, traverse.source);
    fmt::print("  {} frames of {}x{} px, {:.2f} s; {} keyframes\n", traverse.frames, traverse.frame_width_px,
               traverse.frame_height_px, traverse.duration_s, traverse.keyframes.size());
    if (traverse.settings.descriptor)
      fmt::print("  described by {}, {} bytes a keyframe\n", *traverse.settings.descriptor,
                 descriptor_bytes(traverse));
    const auto surveyed =
        std::ranges::count_if(traverse.keyframes, [](const auto& k) { return k.pose.has_value(); });
    if (surveyed > 0) {
      fmt::print("  {} poses from {}", surveyed,
                 traverse.surveyed ? traverse.pose_source : "its own odometry, not surveyed");
      if (const std::optional<double> length_m = place::surveyed_m(traverse))
        fmt::print(", {:.2f} m", *length_m);
      fmt::print("\n");
    } else {
      fmt::print("  no poses\n");
    }
    for (const place::NamedPlace& named : traverse.places) {
      fmt::print("  '{}' at frame {}", named.name, named.frame);
      if (named.distance_m) fmt::print(", {:.2f} m", *named.distance_m);
      fmt::print("\n");
    }
    for (const std::size_t gap : place::gaps_of(traverse)) {
      fmt::print("  interrupted between frames {} and {}\n", traverse.keyframes[gap - 1].frame,
                 traverse.keyframes[gap].frame);
    }
    fmt::print("  settings:{}\n", settings_text(traverse.settings));
  }
}

}  // namespace retrace
