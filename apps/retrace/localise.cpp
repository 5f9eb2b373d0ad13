#include "localise.hpp"

#include "command.hpp"
#include "matches_file.hpp"
#include "progress_bar.hpp"
#include "query_trajectory.hpp"
#include "report/matrix_picture.hpp"
#include "report/run_data.hpp"
#include "report/run_report.hpp"
#include "route_settings.hpp"
#include "run_directory.hpp"
#include "settings.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <place/version.hpp>
#include <vo/base/error.hpp>
#include <vo/base/parallel.hpp>
#include <vo/io/atomic_file.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct LocaliseOptions {
  Settings settings;
  CommonOptions common;
  std::string walk;
  std::string route;
  std::string output;
  bool save_matrices = false;
};

/// One line for each row, nine digits, which tell floats apart.
std::string matrix_csv(const place::CostMatrix& matrix) {
  fmt::memory_buffer text;
  for (std::size_t q = 0; q < matrix.queries; ++q) {
    for (std::size_t r = 0; r < matrix.references; ++r) {
      fmt::format_to(std::back_inserter(text), "{}{:.9g}", r == 0 ? "" : ",", matrix.at(q, r));
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

ordered_json drift_summary(const QueryTrajectory& trajectory) {
  if (!trajectory.why_not.empty()) return {{"corrected", false}, {"reason", trajectory.why_not}};
  const place::CorrectedWalk& walk = trajectory.corrected;
  return {{"corrected", true},
          {"matches_used", trajectory.fixes.size()},
          {"matches_believed", matches_believed(trajectory)},
          {"step_scale", walk.step_scale.back()},
          {"turn_scale", walk.turn_scale.back()}};
}

ordered_json summary(const place::Route& route, const std::string& route_path, const vo::Walk& walk,
                     const Settings& settings, const place::SampledWalk& sampled,
                     const place::Localisation& found, const QueryTrajectory& trajectory) {
  std::size_t matched = 0, accepted = 0, partial = 0, partial_accepted = 0;
  for (const place::Match& match : found.matches) {
    matched += match.place ? 1 : 0;
    accepted += match.accepted ? 1 : 0;
    partial += match.partial ? 1 : 0;
    partial_accepted += match.partial && match.accepted ? 1 : 0;
  }
  ordered_json json{{"query", walk.source},
                    {"query_frames", walk.frames()},
                    {"query_duration_s", walk.time_s.back()},
                    {"route", route_path},
                    {"traverses", ordered_json::array()},
                    {"queries", found.matches.size()},
                    {"matched", matched},
                    {"accepted", accepted},
                    {"partial", partial},
                    {"partial_accepted", partial_accepted},
                    {"accept_score", settings.localiser.acceptance_threshold},
                    {"sequence_length", found.sequence_length},
                    {"lines", found.lines},
                    {"sampling_unit", sampled.unit},
                    {"relative_scale", sampled.scale},
                    {"warnings", walk.warnings},
                    {"version", place::kVersion}};
  json["drift"] = drift_summary(trajectory);
  for (const place::Traverse& traverse : route.traverses) {
    json["traverses"].push_back({{"name", traverse.name}, {"keyframes", traverse.keyframes.size()}});
  }
  return json;
}

void print_table(const fs::path& folder, const ordered_json& summary) {
  const auto row = [](std::string_view name, std::size_t count, std::string_view note) {
    fmt::print("  {:<20}{:>7}   {}\n", name, count, note);
  };
  const auto count = [&](const char* name) { return summary[name].get<std::size_t>(); };
  fmt::print("{} on {}\n", summary["query"].get<std::string>(), summary["route"].get<std::string>());
  row("query keyframes", count("queries"), fmt::format("of {} frames", count("query_frames")));
  row("matched", count("matched"), fmt::format("{} on part of a line", count("partial")));
  row("accepted", count("accepted"),
      fmt::format("score {:g} or more", summary["accept_score"].get<double>()));
  for (const ordered_json& traverse : summary["traverses"]) {
    row("route keyframes", traverse["keyframes"].get<std::size_t>(), traverse["name"].get<std::string>());
  }
  fmt::print("see {}\n", (folder / "report.html").string());
}

void localise(const CLI::App& app, LocaliseOptions& options) {
  Settings& settings = options.settings;
  vo::set_thread_count(settings.threads);
  resolve(app, settings);
  const place::Route route = place::read_route(options.route);
  if (route.traverses.empty())
    throw vo::Error(options.route, "has no traverse", "a route built by `retrace build`");
  take_from_route(app, options.route, route, settings);
  const fs::path folder = options.output;
  prepare_run_directory(folder,
                        {"matches.csv", "trajectory.tum", "trajectory_odometry.tum", "trajectory.csv",
                         "summary.json", "report.html", kRunDataFile, "config.toml"},
                        options.common.force);
  if (settings.correct_drift && has_poses(route)) settings.walk.track_features = true;

  vo::Walk walk;
  {
    ProgressBar bar;
    walk = read_walk(options.walk, settings, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  const auto [found, json] =
      localise_walk(route, options.route, walk, settings, folder, options.save_matrices);
  if (options.common.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    print_table(folder, json);
  }
}

}  // namespace

LocalisedWalk localise_walk(const place::Route& route, const std::string& route_path, const vo::Walk& walk,
                            const Settings& settings, const fs::path& folder, bool save_matrices) {
  const place::SampledWalk sampled =
      place::sample_walk(walk, route, &route.traverses.front(), settings.sampling);
  for (const std::string& warning : sampled.warnings) spdlog::warn("{}", warning);
  place::LocaliserOptions localiser = settings.localiser;
  localiser.whole_matrices = save_matrices;
  place::Localisation found = place::localise(route, walk, sampled, localiser);

  const QueryTrajectory trajectory = query_trajectory(route, walk, sampled, found.matches, settings);
  if (trajectory.asked_for && !trajectory.why_not.empty())
    spdlog::warn("drift is not corrected, trajectory.tum holds poses of matched places: {}",
                 trajectory.why_not);
  ordered_json json = summary(route, route_path, walk, settings, sampled, found, trajectory);
  vo::write_file(folder / "matches.csv", matches_csv(found.matches));
  write_trajectory(trajectory, route, found.matches, folder);
  vo::write_file(folder / "summary.json", json.dump(2) + "\n");
  vo::write_file(folder / "config.toml", to_toml(settings));
  const ordered_json data = run_data(route, walk, sampled, found.matches, found.matrices);
  vo::write_file(folder / kRunDataFile, data.dump());
  vo::write_file(folder / "report.html", run_report(folder, data));
  for (std::size_t i = 0; i < found.matrices.size(); ++i) {
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1);
    const std::vector<std::uint8_t> png = matrix_picture(
        found.matrices[i].enhanced, found.matches, route.traverses[i].name, 900, found.matrices[i].shrink);
    vo::write_file(folder / fmt::format("cost_matrix{}.png", suffix),
                   {reinterpret_cast<const char*>(png.data()), png.size()});
    if (!save_matrices) continue;
    vo::write_file(folder / fmt::format("D{}.csv", suffix), matrix_csv(found.matrices[i].cost));
    vo::write_file(folder / fmt::format("DD{}.csv", suffix), matrix_csv(found.matrices[i].enhanced));
  }
  return {std::move(found), std::move(json)};
}

Command add_localise(CLI::App& root) {
  auto options = std::make_shared<LocaliseOptions>();
  CLI::App* app =
      root.add_subcommand("localise", "find a walk on a route: a position for every keyframe of it");
  app->add_option("walk", options->walk, "video file, folder of images, or camera:N")->required();
  app->add_option("--route", options->route, "route database")->required();
  app->add_option("-o,--output", options->output, "folder for the results")->required();
  app->add_flag(
      "--save-matrices", options->save_matrices,
      "write the cost matrix and the enhanced one as D.csv and DD.csv, a line for each query keyframe");
  add_frame_options(*app, options->settings);
  add_sampling_options(*app, options->settings);
  add_odometry_options(*app, options->settings);
  add_search_options(*app, options->settings);
  add_general_options(*app, options->settings);
  add_config_option(*app, options->common);
  add_force_option(*app, options->common);
  add_json_option(*app, options->common);
  app->footer(
      "What is not given of thumbnails, motion and sampling comes from the route database.\n"
      "Examples:\n"
      "  retrace localise night.mp4 --route route.db -o run\n"
      "  retrace localise night.mp4 --route route.db -o run --sequence-length 20 --enhance local");
  return {app, [app, options] { localise(*app, *options); }};
}

}  // namespace retrace
