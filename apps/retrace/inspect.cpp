#include "command.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <place/route/route_database.hpp>

namespace retrace {
namespace {

using nlohmann::ordered_json;

std::string_view name_of(vo::PatchShape shape) {
  return shape == vo::PatchShape::kGrid ? "grid" : "window";
}

ordered_json as_json(const std::string& path, const place::Route& route) {
  ordered_json json{{"route", path},
                    {"bytes", std::filesystem::file_size(path)},
                    {"schema_version", place::kRouteSchemaVersion},
                    {"software_version", route.software_version},
                    {"thumbnail", {{"width", route.thumbnail.width}, {"height", route.thumbnail.height}}},
                    {"patch",
                     {{"side_px", route.patch.patch_px},
                      {"shape", name_of(route.patch.shape)},
                      {"min_deviation", route.patch.min_deviation},
                      {"min_contrast", route.patch.min_contrast}}},
                    {"sampling",
                     {{"motion", vo::name_of(route.sampling.motion)},
                      {"every", route.sampling.every},
                      {"n", route.sampling.n},
                      {"unit", route.sampling.unit}}},
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
      keyframes.push_back(std::move(k));
    }
    json["traverses"].push_back(
        {{"name", traverse.name},
         {"source", traverse.source},
         {"frames", traverse.frames},
         {"duration_s", traverse.duration_s},
         {"frame_size", {traverse.frame_width_px, traverse.frame_height_px}},
         {"pose_source", traverse.pose_source},
         {"surveyed", traverse.surveyed},
         {"keyframes", traverse.keyframes.size()},
         {"poses", poses},
         {"previews", previews},
         {"motion_model",
          {{"error", traverse.motion_model.error}, {"separation", traverse.motion_model.separation}}},
         {"settings", traverse.settings},
         {"keyframe", std::move(keyframes)}});
  }
  return json;
}

void print(const std::string& path, const place::Route& route) {
  fmt::print("{}: {:.2f} MB, schema {}, written by retrace {}\n", path,
             static_cast<double>(std::filesystem::file_size(path)) / 1e6, place::kRouteSchemaVersion,
             route.software_version);
  fmt::print(
      "thumbnails {}x{} px; patches {} px, {}, at least {} grey levels or {} of their median deviation\n",
      route.thumbnail.width, route.thumbnail.height, route.patch.patch_px, name_of(route.patch.shape),
      route.patch.min_deviation, route.patch.min_contrast);
  if (route.sampling.motion == vo::MotionSource::kNone) {
    fmt::print("sampling: every {} frames\n", route.sampling.every);
  } else {
    const bool metric = route.sampling.metric;
    fmt::print("sampling: by {}, unit {:.4f} {} (n = {})\n", vo::name_of(route.sampling.motion),
               route.sampling.unit, metric ? "m" : "frames of mean speed", route.sampling.n);
  }
  for (const place::Traverse& traverse : route.traverses) {
    fmt::print("\ntraverse '{}' from {}\n", traverse.name, traverse.source);
    fmt::print("  {} frames of {}x{} px, {:.2f} s; {} keyframes\n", traverse.frames, traverse.frame_width_px,
               traverse.frame_height_px, traverse.duration_s, traverse.keyframes.size());
    const auto surveyed =
        std::ranges::count_if(traverse.keyframes, [](const auto& k) { return k.pose.has_value(); });
    if (surveyed > 0) {
      fmt::print("  {} poses from {}", surveyed,
                 traverse.surveyed ? traverse.pose_source : "its own odometry, not surveyed");
      const auto &first = traverse.keyframes.front().distance_m, &last = traverse.keyframes.back().distance_m;
      if (first && last) fmt::print(", {:.2f} m", *last - *first);
      fmt::print("\n");
    } else {
      fmt::print("  no poses\n");
    }
    if (traverse.motion_model.learned()) {
      fmt::print("  motion model (alignment error -> frames):");
      for (std::size_t i = 0; i < traverse.motion_model.error.size(); ++i) {
        fmt::print(" {:.3f}->{:.0f}", traverse.motion_model.error[i], traverse.motion_model.separation[i]);
      }
      fmt::print("\n");
    }
    fmt::print("  settings:");
    for (const auto& [name, value] : traverse.settings) {
      if (!value.empty()) fmt::print(" {}={}", name, value);
    }
    fmt::print("\n");
  }
}

}  // namespace

Command add_inspect(CLI::App& root) {
  struct InspectOptions {
    CommonOptions common;
    std::string route;
  };
  auto options = std::make_shared<InspectOptions>();
  CLI::App* app = root.add_subcommand("inspect", "show what is in a route database");
  app->add_option("route", options->route, "route database")->required();
  add_json_option(*app, options->common);
  app->footer("Example:\n  retrace inspect route.db --json");
  return {app, [options] {
            const place::Route route = place::read_route(options->route);
            if (options->common.json) {
              fmt::print("{}\n", as_json(options->route, route).dump(2));
            } else {
              print(options->route, route);
            }
          }};
}

}  // namespace retrace
