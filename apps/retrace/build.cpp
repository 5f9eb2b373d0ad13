#include "build.hpp"

#include "command.hpp"
#include "progress_bar.hpp"
#include "route_settings.hpp"
#include "run_directory.hpp"
#include "settings.hpp"
#include "survey.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

struct BuildOptions {
  Settings settings;
  CommonOptions common;
  std::string walk;
  std::string output;
  std::string name;
  std::string truth;
  std::string trajectory;
  std::string track;
};

/// The traverse's name where none is given: the recording's, without folders and ending.
std::string default_name(const std::string& walk) {
  std::filesystem::path path(walk);
  if (!path.has_filename()) path = path.parent_path();  // "folder/"
  return path.stem().string();
}

void check_name_is_free(const place::Route& route, const BuildOptions& options) {
  for (const place::Traverse& traverse : route.traverses) {
    if (traverse.name == options.name && !options.common.force) {
      throw vo::Error(options.output, fmt::format("already has a traverse '{}'", options.name),
                      "another --name, or --force to replace it");
    }
  }
}

/// A track's poses are metres about the route's origin; other coordinates on the route would not fit them.
void check_poses_are_geographic(const place::Route& route, const std::string& path) {
  for (const place::Traverse& traverse : route.traverses) {
    if (!route.origin && traverse.surveyed && !traverse.pose_source.empty()) {
      throw vo::Error(path, fmt::format("has poses of {} that are not geographic", traverse.pose_source),
                      "--truth or --trajectory in the same coordinates, or another route");
    }
  }
}

std::size_t put(place::Route& route, place::Traverse traverse) {
  auto& all = route.traverses;
  const auto old = std::ranges::find(all, traverse.name, &place::Traverse::name);
  const auto index = static_cast<std::size_t>(old - all.begin());
  if (old == all.end()) {
    all.push_back(std::move(traverse));
  } else {
    *old = std::move(traverse);
  }
  return index;
}

void print(const BuildOptions& options, const place::Route& route, const AddedTraverse& added) {
  const place::Traverse& traverse = route.traverses[added.index];
  if (options.common.json) {
    const nlohmann::ordered_json json{{"route", options.output},
                                      {"traverse", traverse.name},
                                      {"frames", traverse.frames},
                                      {"duration_s", traverse.duration_s},
                                      {"keyframes", traverse.keyframes.size()},
                                      {"traverses", route.traverses.size()},
                                      {"sampling_unit", route.sampling.unit},
                                      {"relative_scale", added.scale}};
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{}: traverse '{}': {} frames, {:.1f} s, {} keyframes", options.output, traverse.name,
             traverse.frames, traverse.duration_s, traverse.keyframes.size());
  const auto& last = traverse.keyframes.back();
  if (last.distance_m)
    fmt::print(", {:.1f} m surveyed", *last.distance_m - traverse.keyframes.front().distance_m.value_or(0));
  fmt::print("; {} traverse{} in all\n", route.traverses.size(), route.traverses.size() == 1 ? "" : "s");
}

void build(const CLI::App& app, BuildOptions& options) {
  Settings& settings = options.settings;
  vo::set_thread_count(settings.threads);
  resolve(app, settings);
  check_writable(options.output);
  if (options.name.empty()) options.name = default_name(options.walk);

  const bool exists = std::filesystem::exists(options.output);
  place::Route route = exists ? place::read_route(options.output) : new_route(settings);
  if (exists) {
    take_from_route(app, options.output, route, settings);
    const place::Sampling& mine = settings.sampling.sampling;
    if (mine.motion != route.sampling.motion || mine.every != route.sampling.every ||
        mine.n != route.sampling.n) {
      throw vo::Error(options.output, "was sampled with other --motion, --every or --sampling-n",
                      "the same for every traverse of a route; leave them out");
    }
  }
  check_name_is_free(route, options);

  vo::Walk walk;
  {
    ProgressBar bar;
    walk = read_walk(options.walk, settings, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  std::optional<place::Survey> survey;
  if (!options.truth.empty()) survey = survey_from_truth(options.truth, walk);
  if (!options.trajectory.empty()) survey = survey_from_trajectory(options.trajectory, walk);
  if (!options.track.empty()) {
    check_poses_are_geographic(route, options.output);
    survey = survey_from_track(options.track, walk, route.origin);
  }

  const AddedTraverse added = add_traverse(route, options.name, walk, survey, settings);
  place::write_route(options.output, route);
  print(options, route, added);
}

}  // namespace

AddedTraverse add_traverse(place::Route& route, const std::string& name, const vo::Walk& walk,
                           const std::optional<place::Survey>& survey, const Settings& settings) {
  // A route's unit comes from its first traverse; the walk that replaces it is tied to what it was.
  const place::Traverse* reference = route.traverses.empty() ? nullptr : &route.traverses.front();
  const place::SampledWalk sampled = place::sample_walk(walk, route, reference, settings.sampling);
  for (const std::string& warning : sampled.warnings) spdlog::warn("{}", warning);
  if (sampled.frames.size() < 2) {
    throw vo::Error(walk.source, "gives a single keyframe",
                    "a longer walk, or a smaller --sampling-n or --every");
  }
  place::Traverse traverse =
      place::make_traverse(name, walk, sampled, survey ? survey : survey_from_odometry(sampled.trajectory));
  for (const SettingEntry& entry : entries(settings)) traverse.settings[entry.name] = entry.value;
  route.sampling.unit = sampled.unit;
  if (reference == nullptr) route.sampling.metric = sampled.metric;
  return {put(route, std::move(traverse)), sampled.scale};
}

Command add_build(CLI::App& root) {
  auto options = std::make_shared<BuildOptions>();
  CLI::App* app = root.add_subcommand("build", "make a route database of a walk, or add a traverse to one");
  app->add_option("walk", options->walk, "video file, folder of images, or camera:N")->required();
  app->add_option("-o,--output", options->output, "route database to create or add to")->required();
  app->add_option("--name", options->name, "name of the traverse [the recording's]");
  CLI::Option* truth = app->add_option("--truth", options->truth,
                                       "truth.csv of the walk: position and distance of every frame");
  app->add_option("--trajectory", options->trajectory,
                  "surveyed poses of the walk, TUM format, seconds since its first frame")
      ->excludes(truth);
  app->add_option("--track", options->track,
                  "GPS track of the walk: .gpx, or .csv with time_s since the first frame, lat_deg, lon_deg")
      ->excludes(truth)
      ->excludes("--trajectory");
  add_frame_options(*app, options->settings);
  add_sampling_options(*app, options->settings);
  add_odometry_options(*app, options->settings);
  add_general_options(*app, options->settings);
  add_config_option(*app, options->common);
  add_force_option(*app, options->common);
  add_json_option(*app, options->common);
  app->footer(
      "Examples:\n"
      "  retrace build day.mp4 -o route.db\n"
      "  retrace build evening.mp4 -o route.db --name evening    (a second traverse of the same route)\n"
      "  retrace build frames/ -o route.db --motion none --every 1");
  return {app, [app, options] { build(*app, *options); }};
}

}  // namespace retrace
