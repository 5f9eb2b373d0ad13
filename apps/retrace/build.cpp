#include "command.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <place/place.hpp>
#include <place/route/route_lock.hpp>
#include <place/route/survey.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

struct BuildOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;
  std::string output;
  std::string name;
  std::string truth;
  std::string trajectory;
  std::string track;
  std::string track_name;
  std::optional<double> trajectory_start_s, track_start_s;
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

std::optional<place::Survey> survey_of(const BuildOptions& options, const vo::Walk& walk,
                                       place::Route& route) {
  if (!options.truth.empty()) return place::survey_from_truth(options.truth, walk);
  place::SurveyOptions form = place::survey_options(options.settings);
  if (!options.trajectory.empty()) {
    form.start_s = options.trajectory_start_s;
    return place::survey_from_trajectory(options.trajectory, walk, form);
  }
  if (options.track.empty()) return {};
  form.start_s = options.track_start_s;
  form.track_name = options.track_name;
  return place::survey_from_track(options.track, walk, route, form);
}

/// The settings without those that, as motion is no file's, the survey alone has a use for.
place::Settings without_survey(const BuildOptions& options, const place::Settings* route) {
  place::Settings settings = options.settings;
  const std::optional<std::string> motion =
      !settings.motion && route != nullptr ? route->motion : settings.motion;
  if (motion == "file") return settings;
  if (!options.trajectory.empty()) settings.axes.reset();
  if (!options.trajectory.empty() || !options.track.empty()) settings.motion_file_gap_s.reset();
  return settings;
}

void print(const BuildOptions& options, const place::Route& route, const place::AddedTraverse& added) {
  const place::Traverse& traverse = route.traverses[added.index];
  if (options.common.json) {
    const nlohmann::ordered_json json{{"route", options.output},
                                      {"traverse", traverse.name},
                                      {"frames", traverse.frames},
                                      {"duration_s", traverse.duration_s},
                                      {"keyframes", traverse.keyframes.size()},
                                      {"traverses", route.traverses.size()},
                                      {"sampling_unit", route.unit},
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

void build(BuildOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  check_writable(options.output);
  if (options.name.empty()) options.name = default_name(options.walk.front());
  const place::RouteLock lock(options.output, {.waiting = [&] {
                                spdlog::info("{}: another build adds to it; waiting", options.output);
                              }});
  const bool exists = std::filesystem::exists(options.output);
  place::Route route =
      exists ? place::read_route(options.output) : place::new_route(without_survey(options, nullptr));
  check_name_is_free(route, options);
  const place::Settings* const of_route = exists ? &route.settings : nullptr;
  const place::Settings settings = place::resolve(without_survey(options, of_route),
                                                  {.purpose = place::Purpose::kRoute, .route = of_route});

  vo::Walk walk;
  {
    ProgressBar bar;
    walk = place::read(options.walk, settings, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  const std::optional<place::Survey> survey = survey_of(options, walk, route);
  if (survey) {
    for (const std::string& warning : survey->warnings) spdlog::warn("{}", warning);
  }
  const place::AddedTraverse added =
      place::add(route, options.name, walk, survey, settings, options.common.force);
  for (const std::string& warning : added.warnings) spdlog::warn("{}", warning);
  lock.check_unchanged();
  place::write_route(options.output, route);
  print(options, route, added);
}

}  // namespace

std::function<void()> declare_build(Arguments& arguments) {
  auto options = std::make_shared<BuildOptions>();
  arguments.positional("walk", options->walk, kWalkArgument);
  arguments.option("-o,--output", options->output, "route database to create or add to").required();
  arguments.option("--name", options->name, "name of the traverse [the recording's]");
  const Argument truth = arguments.option("--truth", options->truth,
                                          "truth.csv of the walk: position and distance of every frame");
  Argument trajectory =
      arguments.option("--trajectory", options->trajectory,
                       "surveyed poses of the walk, TUM format, seconds since its first frame");
  Argument track = arguments.option(
      "--track", options->track,
      "GPS track of the walk: .gpx, or .csv with time_s since the first frame, lat_deg, lon_deg");
  track.excludes(truth).excludes(trajectory.excludes(truth));
  arguments
      .option(
          "--trajectory-start-s", options->trajectory_start_s,
          "seconds that the trajectory's clock shows at the first frame [0, or by the video's creation time]")
      .needs(trajectory);
  arguments
      .option(
          "--track-start-s", options->track_start_s,
          "seconds from a .gpx file's first point, or of a .csv file's clock, to the first frame [0, or by "
          "the video's creation time]")
      .needs(track);
  arguments
      .option("--track-name", options->track_name,
              "of several tracks in a .gpx file the one so called, or its number from 1")
      .needs(track);
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kDescribing, kMotion, kOdometry, kGeneral});
  arguments.common(options->common);
  arguments.footer(
      "Examples:\n"
      "  retrace build day.mp4 -o route.db\n"
      "  retrace build evening.mp4 -o route.db --name evening    (a second traverse of the same route)\n"
      "  retrace build frames/ -o route.db --motion none --every 1");
  return [options] { build(*options); };
}

}  // namespace retrace
