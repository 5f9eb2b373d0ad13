#include "added_traverse.hpp"
#include "build_options.hpp"
#include "command.hpp"
#include "import_route.hpp"
#include "report/build_report.hpp"
#include "walk_reading.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <spdlog/spdlog.h>

#include <place/place.hpp>
#include <place/route/named_places.hpp>
#include <place/route/route_lock.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

void build(BuildOptions& options) {
  check_build(options);
  if (!options.import.empty()) return import_route(options.import, options.output, options.common);
  vo::set_thread_count(options.settings.threads.value_or(0));
  std::vector<place::PlaceName> names;
  if (!options.places.empty()) names = place::read_place_names(options.places);
  const place::RouteLock lock(options.output, {.waiting = [&] {
                                spdlog::info("{}: another build adds to it; waiting", options.output);
                              }});
  const bool exists = std::filesystem::exists(options.output);
  place::Route route;
  if (exists) route = place::read_route(options.output);
  const place::Settings given = settings_beside(options.survey, options.settings, route.settings.motion);
  if (!exists) route = place::new_route(given);
  check_name_is_free(options, route);
  const place::Settings settings =
      place::resolve(given, {.purpose = place::Purpose::kRoute, .route = exists ? &route.settings : nullptr});

  const vo::Walk walk = read_with_bar(options.walk, settings);
  log_warnings(walk.warnings);
  const std::optional<place::Survey> survey = read_survey(options.survey, options.settings, walk, route);
  if (survey) log_warnings(survey->warnings);
  const place::AddedTraverse added =
      place::add(route, options.name, walk, survey, settings, options.common.force);
  log_warnings(added.warnings);
  place::Traverse& traverse = route.traverses[added.index];
  traverse.places = place::named_places(names, traverse);
  lock.write(route);
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
