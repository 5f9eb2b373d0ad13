#include "added_traverse.hpp"
#include "command.hpp"
#include "import_route.hpp"
#include "json_file.hpp"
#include "progress_bar.hpp"
#include "report/build_report.hpp"
#include "run_directory.hpp"
#include "survey_files.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <place/place.hpp>
#include <place/route/named_places.hpp>
#include <place/route/route_lock.hpp>
#include <place/stage_options.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

struct BuildOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;
  std::string output;
  std::string name;
  SurveyFiles survey;
  std::string import;
  std::string places;
  std::string report;
};

/// The default name of the traverse: the recording's, without folders and extension.
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

void check_report(const BuildOptions& options) {
  check_writable(options.report);
  const std::filesystem::path report = options.report;
  std::error_code ignored;
  const auto real = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), ignored);
  };
  if (real(report) == real(options.output))
    throw vo::Error(options.report, "is the route itself", "another file for --report");
  if (std::filesystem::exists(report) && !options.common.force)
    throw vo::Error(options.report, "already exists", "another file, or --force to overwrite");
}

void build(BuildOptions& options) {
  if (!options.import.empty()) {
    if (!options.walk.empty() || !options.name.empty() || options.settings != place::Settings{} ||
        options.survey != SurveyFiles{} || !options.places.empty() || !options.report.empty())
      throw vo::Error("--import",
                      "leaves no choice of a walk, a name, places, a survey, a report or settings",
                      "--output alone: all else is in the folder");
    return import_route(options.import, options.output, options.common);
  }
  if (options.walk.empty())
    throw vo::Error("walk", "is missing", std::string(kWalkArgument) + ", or --import");
  vo::set_thread_count(options.settings.threads.value_or(0));
  check_writable(options.output);
  if (!options.report.empty()) check_report(options);
  std::vector<place::PlaceName> names;
  if (!options.places.empty()) names = place::read_place_names(options.places);
  if (options.name.empty()) options.name = default_name(options.walk.front());
  const place::RouteLock lock(options.output, {.waiting = [&] {
                                spdlog::info("{}: another build adds to it; waiting", options.output);
                              }});
  const bool exists = std::filesystem::exists(options.output);
  place::Route route;
  if (exists) route = place::read_route(options.output);
  const place::Settings given = settings_beside(options.survey, options.settings, route.settings.motion);
  if (!exists) route = place::new_route(given);
  check_name_is_free(route, options);
  const place::Settings settings =
      place::resolve(given, {.purpose = place::Purpose::kRoute, .route = exists ? &route.settings : nullptr});

  vo::Walk walk;
  {
    ProgressBar bar(options.walk.front());
    walk = place::read(options.walk, settings, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  const std::optional<place::Survey> survey = read_survey(options.survey, options.settings, walk, route);
  if (survey) {
    for (const std::string& warning : survey->warnings) spdlog::warn("{}", warning);
  }
  const place::AddedTraverse added =
      place::add(route, options.name, walk, survey, settings, options.common.force);
  for (const std::string& warning : added.warnings) spdlog::warn("{}", warning);
  place::Traverse& traverse = route.traverses[added.index];
  traverse.places = place::named_places(names, traverse);
  lock.check_unchanged();
  place::write_route(options.output, route);
  if (!options.report.empty()) vo::write_file(options.report, build_report(route, added, walk, settings));
  print_added(options.output, route, added, options.common.json);
}

}  // namespace

std::function<void()> declare_build(Arguments& arguments) {
  auto options = std::make_shared<BuildOptions>();
  arguments.positional("walk", options->walk, kWalkArgument).optional();
  arguments.option("--import", options->import,
                   "instead of a walk: a folder written by `retrace inspect --export` [none]");
  arguments.option("-o,--output", options->output, "route database to create or add to").required();
  arguments.option("--name", options->name, "name of the traverse [the recording's]");
  declare_survey(arguments, options->survey);
  arguments.option("--places", options->places,
                   "names of places, which `follow --announce` says in passing: .csv with frame,name or "
                   "distance_m,name");
  arguments.option("--report", options->report,
                   "page that shows how the walk's motion was learned and sampled, such as day.html [none]");
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
