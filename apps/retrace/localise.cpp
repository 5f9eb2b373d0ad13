#include "command.hpp"
#include "progress_bar.hpp"
#include "run_directory.hpp"
#include "run_files.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

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

void localise(const LocaliseOptions& options) {
  vo::set_thread_count(options.settings.threads.value_or(0));
  check_not_swapped(options.walk.front(), options.route);
  const place::Route route =
      place::read_route(options.route, {.view_points = options.settings.verify.value_or(0) > 0});
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
  const WrittenRun written =
      localise_into(options.output, route, options.route, walk, options.settings, options.save_matrices);
  if (options.common.json) {
    fmt::print("{}", written.summary);
  } else {
    print_table(options, walk, route, written.run);
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
  using enum place::SettingGroup;
  arguments.settings(options->settings, {kReading, kDescribing, kMotion, kOdometry, kSearch, kGeneral});
  arguments.common(options->common);
  arguments.footer(
      "What is not given comes from the route database.\n"
      "Examples:\n"
      "  retrace localise night.mp4 --route route.db -o run\n"
      "  retrace localise night.mp4 --route route.db -o run --sequence-length 20 --enhance local");
  return [options] { localise(*options); };
}

}  // namespace retrace
