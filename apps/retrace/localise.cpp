#include "command.hpp"
#include "launched_team.hpp"
#include "run_directory.hpp"
#include "run_files.hpp"
#include "run_table.hpp"
#include "stored_run.hpp"
#include "walk_reading.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

struct LocaliseOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;
  std::string route;
  std::string output;
  std::string memory;
  bool save_matrices = false;
};

/// `team`: the processes that divide the search; null: this one alone.
void localise(const LocaliseOptions& options, LaunchedTeam* team) {
  check_not_swapped(options.walk.front(), options.route);
  const std::optional<StoredRun> stored = stored_run(team, options.memory);
  place::Route route = place::read_route(
      options.route,
      {.previews = !stored, .view_points = options.settings.verify.value_or(0) > 0, .descriptors = !stored});
  if (route.traverses.empty())
    throw vo::Error(options.route, "has no traverse", "a route built by `retrace build`");
  place::resolve(options.settings, place::on_route(route));  // refuses settings before the walk is read
  prepare_run_directory(options.output, kRunFiles, options.common.force);

  const vo::Walk walk = read_with_bar(options.walk, route, options.settings);
  log_warnings(walk.warnings);
  const WrittenRun written = localise_into(options.output, route, options.route, walk, options.settings,
                                           options.save_matrices, stored ? &*stored : nullptr);
  if (options.common.json) {
    fmt::print("{}", written.summary);
  } else {
    fmt::print("{}", run_table(walk, route, options.route, written.run));
    fmt::print("see {}\n", (std::filesystem::path(options.output) / "report.html").string());
  }
}

void run_localise(const LocaliseOptions& options) {
  const std::unique_ptr<LaunchedTeam> team = launched_team();
  vo::set_thread_count(options.settings.threads.value_or(threads_of_each()));
  if (team == nullptr) return localise(options, nullptr);
  run_as_team(
      *team, [&] { localise(options, team.get()); },
      [&] { serve_run(options.route, *team, options.save_matrices); });
}

}  // namespace

std::function<void()> declare_localise(Arguments& arguments) {
  auto options = std::make_shared<LocaliseOptions>();
  arguments.positional("walk", options->walk, kWalkArgument);
  arguments.option("--route", options->route, "route database").required();
  arguments.option("-o,--output", options->output, "folder for the results").required();
  arguments.flag(
      "--save-matrices", options->save_matrices,
      "write the cost matrix and the enhanced one as D.csv and DD.csv, a line for each query keyframe");
  arguments.option("--memory", options->memory,
                   "most memory to use, as 2G: the route's descriptors are read from the database in parts");
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kDescribing, kMotion, kOdometry, kSearch, kGeneral});
  arguments.common(options->common);
  arguments.footer(
      "What is not given comes from the route database.\n"
      "Examples:\n"
      "  retrace localise night.mp4 --route route.db -o run\n"
      "  retrace localise night.mp4 --route route.db -o run --sequence-length 20 --enhance local\n"
      "  mpirun -n 8 retrace localise night.mp4 --route city.db -o run    (each process searches a part of "
      "the route)");
  return [options] { run_localise(*options); };
}

}  // namespace retrace
