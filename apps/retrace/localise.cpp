#include "command.hpp"
#include "launched_team.hpp"
#include "memory_limit.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"
#include "run_files.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

struct LocaliseOptions {
  place::Settings settings;
  CommonOptions common;
  std::vector<std::string> walk;
  std::string route;
  std::string output;
  std::string memory;
  bool save_matrices = false;
};

void print_table(const LocaliseOptions& options, const vo::Walk& walk, const place::Route& route,
                 const place::Run& run) {
  const auto row = [](std::string_view name, auto count, std::string_view note) {
    fmt::print("  {:<20}{:>7}   {}\n", name, count, note);
  };
  const auto count = [&](auto what) { return std::ranges::count_if(run.matches, what); };
  fmt::print("{} on {}\n", walk.source, options.route);
  row("query keyframes", run.matches.size(), fmt::format("of {} frames", walk.frames()));
  row("matched", count([](const place::Match& m) { return m.place.has_value(); }),
      fmt::format("{} on part of a line", count([](const place::Match& m) { return m.partial; })));
  row("accepted", count([](const place::Match& m) { return m.accepted; }),
      run.settings.accept_score
          ? fmt::format("score {:g} or more", *run.settings.accept_score)
          : fmt::format("probability {:g} or more", run.settings.accept_probability.value_or(0)));
  for (const place::Traverse& traverse : route.traverses)
    row("route keyframes", traverse.keyframes.size(), traverse.name);
  fmt::print("see {}\n", (fs::path(options.output) / "report.html").string());
}

/// `team`: null for one process.
void localise(const LocaliseOptions& options, LaunchedTeam* team) {
  check_not_swapped(options.walk.front(), options.route);
  std::optional<std::size_t> memory_bytes;
  if (!options.memory.empty()) memory_bytes = bytes_of(options.memory);
  if (memory_bytes && team != nullptr)
    throw vo::Error("--memory", "has no effect on several processes", "more of them");
  if (memory_bytes) limit_memory(*memory_bytes);
  const bool in_memory = !memory_bytes && team == nullptr;
  place::Route route =
      place::read_route(options.route, {.previews = in_memory,
                                        .view_points = options.settings.verify.value_or(0) > 0,
                                        .descriptors = in_memory});
  if (route.traverses.empty())
    throw vo::Error(options.route, "has no traverse", "a route built by `retrace build`");
  place::resolve(options.settings, {.route = &route.settings,
                                    .route_has_poses = place::has_poses(route),
                                    .route_has_points = place::has_view_points(route)});
  prepare_run_directory(options.output, kRunFiles, options.common.force);

  vo::Walk walk;
  {
    ProgressBar bar(options.walk.front());
    walk = place::read(options.walk, route, options.settings, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  place::Alone alone;
  const StoredRun stored{.route = &route,
                         .team = team != nullptr ? static_cast<place::Team*>(team) : &alone,
                         .launched = team,
                         .memory_bytes = memory_bytes};
  const WrittenRun written = localise_into(options.output, route, options.route, walk, options.settings,
                                           options.save_matrices, in_memory ? nullptr : &stored);
  if (options.common.json) {
    fmt::print("{}", written.summary);
  } else {
    print_table(options, walk, route, written.run);
  }
}

/// As one of several processes: the first one finds the walk and writes, the others search their parts.
void localise_together(const LocaliseOptions& options, LaunchedTeam& team) {
  try {
    if (team.rank() > 0) {
      serve_run(options.route, team, options.save_matrices);
      return;
    }
    localise(options, &team);
    team.exchange({});  // the others may end
  } catch (const std::exception& error) {
    team.fail(error.what());
    if (team.rank() == 0) throw;  // one line is enough
  }
}

void run_localise(const LocaliseOptions& options) {
  const std::unique_ptr<LaunchedTeam> team = launched_team();
  vo::set_thread_count(options.settings.threads.value_or(threads_of_each()));
  if (team != nullptr) {
    localise_together(options, *team);
  } else {
    localise(options, nullptr);
  }
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
