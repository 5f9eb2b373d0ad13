#include "localise.hpp"

#include "command.hpp"
#include "progress_bar.hpp"
#include "query_trajectory.hpp"
#include "report/matrix_picture.hpp"
#include "report/page.hpp"
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

std::string csv_field(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

std::string matches_csv(const std::vector<place::Match>& matches) {
  std::string csv =
      "query_frame,query_time_s,traverse,reference_frame,reference_time_s,reference_distance_m,score,"
      "accepted\n";
  for (const place::Match& match : matches) {
    csv += fmt::format("{},{:.6f},", match.query_frame, match.query_time_s);
    if (match.place) {
      csv += fmt::format("{},{},{:.6f},{}", match.place->traverse, match.place->frame, match.place->time_s,
                         csv_field(match.place->distance_m));
    } else {
      csv += ",,,";
    }
    csv += fmt::format(",{:.9g},{}\n", match.score, match.accepted ? 1 : 0);
  }
  return csv;
}

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
  // Half of its weight gone, a match is let go.
  const auto believed = std::ranges::count_if(walk.fix_weight, [](double weight) { return weight >= 0.5; });
  return {{"corrected", true},
          {"matches_used", trajectory.fixes.size()},
          {"matches_believed", believed},
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

std::string report(const ordered_json& summary, const place::Route& route, const place::Localisation& found,
                   const Settings& settings, const std::vector<std::vector<std::uint8_t>>& pictures) {
  const auto count = [&](const char* name) { return std::to_string(summary[name].get<std::size_t>()); };
  Page page("Where the walk was found", fmt::format("{} on {}", summary["query"].get<std::string>(),
                                                    summary["route"].get<std::string>()));
  page.facts({{"Query keyframes", fmt::format("{} of {} frames", count("queries"), count("query_frames"))},
              {"Matched", count("matched")},
              {"Accepted", fmt::format("{} (score {} or more)", count("accepted"),
                                       settings.localiser.acceptance_threshold)},
              {"On part of a line",
               fmt::format("{}, of them accepted {} (within half a sequence of an end of either walk)",
                           count("partial"), count("partial_accepted"))},
              {"Sequence length", fmt::format("{} keyframes", found.sequence_length)},
              {"Relative scale", fmt::format("{:.3f}", summary["relative_scale"].get<double>())}});
  page.paragraph("Precision and recall need the truth: retrace evaluate.");
  for (const auto& warning : summary["warnings"]) page.paragraph("Warning: " + warning.get<std::string>());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    page.heading("Cost matrix against " + route.traverses[i].name);
    page.picture(pictures[i], "Enhanced cost matrix with the matches over it",
                 "Query keyframes from left to right, reference keyframes from bottom to top, dark where "
                 "alike. Filled "
                 "orange: accepted. Hollow blue: refused.");
  }
  page.heading("Settings");
  std::vector<std::vector<std::string>> rows;
  for (const SettingEntry& entry : entries(settings))
    rows.push_back({entry.name, entry.value, entry.description});
  page.table({"setting", "value", "what it is"}, rows);
  return page.html();
}

void localise(const CLI::App& app, LocaliseOptions& options) {
  Settings& settings = options.settings;
  vo::set_thread_count(settings.threads);
  resolve(app, settings);
  const place::Route route = place::read_route(options.route, {.previews = false});
  if (route.traverses.empty())
    throw vo::Error(options.route, "has no traverse", "a route built by `retrace build`");
  take_from_route(app, options.route, route, settings);
  const fs::path folder = options.output;
  prepare_run_directory(folder,
                        {"matches.csv", "trajectory.tum", "trajectory_odometry.tum", "trajectory.csv",
                         "summary.json", "report.html", "config.toml"},
                        options.common.force);
  if (settings.correct_drift && has_poses(route)) settings.walk.track_features = true;

  vo::Walk walk;
  {
    ProgressBar bar;
    vo::WalkOptions without_previews = settings.walk;
    without_previews.preview_width_px = 0;
    walk = vo::read_walk(options.walk, without_previews, bar.callback());
  }
  for (const std::string& warning : walk.warnings) spdlog::warn("{}", warning);
  const auto [found, json] =
      localise_walk(route, options.route, walk, settings, folder, options.save_matrices);
  if (options.common.json) {
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{}: {} of {} query keyframes accepted ({} matched, {} on part of a line); see {}\n",
               options.output, json["accepted"].get<std::size_t>(), found.matches.size(),
               json["matched"].get<std::size_t>(), json["partial"].get<std::size_t>(),
               (folder / "report.html").string());
  }
}

}  // namespace

LocalisedWalk localise_walk(const place::Route& route, const std::string& route_path, const vo::Walk& walk,
                            const Settings& settings, const fs::path& folder, bool save_matrices) {
  const place::SampledWalk sampled =
      place::sample_walk(walk, route, &route.traverses.front(), settings.sampling);
  for (const std::string& warning : sampled.warnings) spdlog::warn("{}", warning);
  place::Localisation found = place::localise(route, walk, sampled, settings.localiser);

  std::vector<std::vector<std::uint8_t>> pictures;
  for (std::size_t i = 0; i < route.traverses.size(); ++i) {
    pictures.push_back(matrix_picture(found.matrices[i].enhanced, found.matches, route.traverses[i].name));
  }
  const QueryTrajectory trajectory = query_trajectory(route, walk, found.matches, settings);
  if (trajectory.asked_for && !trajectory.why_not.empty())
    spdlog::warn("drift is not corrected, trajectory.tum holds poses of matched places: {}",
                 trajectory.why_not);
  ordered_json json = summary(route, route_path, walk, settings, sampled, found, trajectory);
  vo::write_file(folder / "matches.csv", matches_csv(found.matches));
  write_trajectory(trajectory, route, found.matches, folder);
  vo::write_file(folder / "summary.json", json.dump(2) + "\n");
  vo::write_file(folder / "config.toml", to_toml(settings));
  vo::write_file(folder / "report.html", report(json, route, found, settings, pictures));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1);
    vo::write_file(folder / fmt::format("cost_matrix{}.png", suffix),
                   {reinterpret_cast<const char*>(pictures[i].data()), pictures[i].size()});
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
