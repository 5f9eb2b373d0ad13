#include "run_files.hpp"

#include "json_file.hpp"
#include "report/kept_matrices.hpp"
#include "report/matrix_picture.hpp"
#include "report/run_data.hpp"
#include "report/run_report.hpp"
#include "run_directory.hpp"
#include "settings_file.hpp"
#include "stored_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <place/match/match_io.hpp>
#include <place/match/stored_search.hpp>
#include <place/match/walk_gaps.hpp>
#include <place/route/geographic.hpp>
#include <place/version.hpp>
#include <vo/base/degrees.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv_columns.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// One line for each row, with nine digits, which distinguish all floats.
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

ordered_json drift_summary(const place::QueryTrajectory& trajectory) {
  if (!trajectory.why_not.empty()) return {{"corrected", false}, {"reason", trajectory.why_not}};
  const place::CorrectedWalk& walk = trajectory.corrected;
  return {{"corrected", true},
          {"matches_used", trajectory.fixes.size()},
          {"matches_believed", matches_believed(trajectory)},
          {"step_scale", walk.step_scale.back()},
          {"turn_scale", walk.turn_scale.back()}};
}

ordered_json probability_summary(const place::Run& run) {
  switch (run.probability_source) {
    case place::ProbabilitySource::kDecoys:
      return {{"given", true}, {"by", "the walk played backwards"}, {"wrong_share", run.wrong_share}};
    case place::ProbabilitySource::kSearch:
      return {{"given", true}, {"by", "the search alone: fewer than ten matches"}};
    case place::ProbabilitySource::kNone:
      break;
  }
  return {{"given", false}};
}

ordered_json summary(const place::Route& route, const std::string& route_path, const vo::Walk& walk,
                     const place::Run& run) {
  std::size_t matched = 0, accepted = 0, partial = 0, partial_accepted = 0;
  for (const place::Match& match : run.matches) {
    matched += match.place ? 1 : 0;
    accepted += match.accepted ? 1 : 0;
    partial += match.partial ? 1 : 0;
    partial_accepted += match.partial && match.accepted ? 1 : 0;
  }
  std::vector<std::string> warnings = walk.warnings;
  warnings.insert(warnings.end(), run.sampled.warnings.begin(), run.sampled.warnings.end());
  std::vector<std::size_t> gaps;
  for (const std::size_t keyframe : place::gaps_at(run.sampled.frames, walk.time_s))
    gaps.push_back(run.sampled.frames[keyframe]);
  ordered_json json{{"query", walk.source},
                    {"query_frames", walk.frames()},
                    {"query_start_utc_s", walk.start_utc_s ? ordered_json(*walk.start_utc_s) : nullptr},
                    {"query_duration_s", walk.time_s.back()},
                    {"query_frames_after_gaps", gaps},
                    {"route", route_path},
                    {"traverses", ordered_json::array()},
                    {"queries", run.matches.size()},
                    {"matched", matched},
                    {"accepted", accepted},
                    {"partial", partial},
                    {"partial_accepted", partial_accepted},
                    {"search", run.settings.search.value_or("openseqslam")},
                    {"accept_score", nullptr},
                    {"accept_probability", nullptr},
                    {"sequence_length", run.sequence_length},
                    {"lines", run.lines},
                    {"motion", *run.settings.motion},
                    {"sampling_unit", run.sampled.unit},
                    {"relative_scale", run.sampled.scale},
                    {"relative_scale_gain", run.sampled.scale_gain},
                    {"warnings", warnings},
                    {"version", place::kVersion}};
  if (run.settings.accept_score) json["accept_score"] = *run.settings.accept_score;
  if (run.settings.accept_probability) json["accept_probability"] = *run.settings.accept_probability;
  json["probability"] = probability_summary(run);
  json["cells_looked_at"] = run.looked_at;
  for (const std::string& warning : run.warnings) json["warnings"].push_back(warning);
  json["drift"] = drift_summary(run.drift);
  for (const place::Traverse& traverse : route.traverses) {
    json["traverses"].push_back({{"name", traverse.name}, {"keyframes", traverse.keyframes.size()}});
  }
  return json;
}

/// A trajectory, and the probability of the match that each of its poses belongs to.
struct SurePoses {
  vo::Trajectory poses;
  std::vector<std::optional<double>> probability;
};

/// Accepted matches' poses, at the query's times. `surveyed`: only those on surveyed traverses.
SurePoses matched_poses(const std::vector<place::Match>& matches, const place::Route& route, bool surveyed) {
  SurePoses sure;
  for (const place::Match& match : matches) {
    if (!match.accepted || !match.place->pose) continue;
    const auto on = std::ranges::find(route.traverses, match.place->traverse, &place::Traverse::name);
    if (surveyed && (on == route.traverses.end() || !on->surveyed)) continue;
    sure.poses.push_back({match.query_time_s, *match.place->pose});
    sure.probability.push_back(match.probability);
  }
  return sure;
}

/// For maps, where the route's poses are on the earth.
void write_geographic(const fs::path& folder, const SurePoses& sure, const place::Route& route,
                      std::optional<double> start_utc_s) {
  if (!route.origin || sure.poses.empty()) return;
  vo::write_file(folder / "trajectory.geojson",
                 place::to_geojson(sure.poses, *route.origin, sure.probability));
  vo::write_file(folder / "trajectory.gpx",
                 place::to_gpx(sure.poses, *route.origin, start_utc_s, sure.probability));
}

vo::Trajectory without_covariance(const place::CorrectedWalk& walk) {
  vo::Trajectory trajectory;
  for (const place::UncertainPose& pose : walk.poses) trajectory.push_back({pose.time_s, pose.pose});
  return trajectory;
}

/// A row of trajectory.csv.
struct TrajectoryRow {
  std::int64_t query_frame = 0;
  place::UncertainPose pose;
  place::RoutePosition on_route;
  double step_scale = 1, turn_scale = 1;
  std::optional<double> match_weight;
};

std::string six(double value) {
  return fmt::format("{:.6f}", value);
}
std::string nine(double value) {
  return fmt::format("{:.9g}", value);
}

using Row = TrajectoryRow;
constexpr std::array kTrajectoryColumns{
    vo::CsvColumn<Row>{"query_frame", [](const Row& r) { return fmt::format("{}", r.query_frame); }},
    vo::CsvColumn<Row>{"time_s", [](const Row& r) { return six(r.pose.time_s); }},
    vo::CsvColumn<Row>{"x_m", [](const Row& r) { return six(r.pose.pose.x_m); }},
    vo::CsvColumn<Row>{"y_m", [](const Row& r) { return six(r.pose.pose.y_m); }},
    vo::CsvColumn<Row>{"heading_deg",
                       [](const Row& r) { return six(r.pose.pose.heading_rad * vo::kDegPerRad); }},
    vo::CsvColumn<Row>{"cov_xx_m2", [](const Row& r) { return nine(r.pose.covariance[0]); }},
    vo::CsvColumn<Row>{"cov_xy_m2", [](const Row& r) { return nine(r.pose.covariance[1]); }},
    vo::CsvColumn<Row>{"cov_yy_m2", [](const Row& r) { return nine(r.pose.covariance[4]); }},
    vo::CsvColumn<Row>{"heading_sd_deg",
                       [](const Row& r) { return six(std::sqrt(r.pose.covariance[8]) * vo::kDegPerRad); }},
    vo::CsvColumn<Row>{"distance_m", [](const Row& r) { return six(r.on_route.distance_m); }},
    vo::CsvColumn<Row>{"lateral_m", [](const Row& r) { return six(r.on_route.right_m); }},
    vo::CsvColumn<Row>{"step_scale", [](const Row& r) { return six(r.step_scale); }},
    vo::CsvColumn<Row>{"turn_scale", [](const Row& r) { return six(r.turn_scale); }},
    vo::CsvColumn<Row>{
        "match_weight",
        [](const Row& r) { return r.match_weight ? fmt::format("{:.4f}", *r.match_weight) : std::string(); }},
};

std::string trajectory_csv(const place::QueryTrajectory& t, const std::vector<place::Match>& matches) {
  std::vector<TrajectoryRow> rows;
  for (std::size_t i = 0; i < t.corrected.poses.size(); ++i) {
    rows.push_back({.query_frame = matches[i].query_frame,
                    .pose = t.corrected.poses[i],
                    .on_route = t.on_route[i],
                    .step_scale = t.corrected.step_scale[i],
                    .turn_scale = t.corrected.turn_scale[i],
                    .match_weight = {}});
  }
  for (std::size_t i = 0; i < t.fixes.size(); ++i)
    rows[t.fixes[i].node].match_weight = t.corrected.fix_weight[i];
  return vo::to_csv<TrajectoryRow>(rows, kTrajectoryColumns);
}

void write_matrices(const fs::path& folder, const std::vector<KeptMatrix>& matrices,
                    const place::Route& route, const std::vector<place::Match>& matches, bool whole) {
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1);
    constexpr int kSide_px = 900;
    const std::vector<std::uint8_t> png =
        matrix_picture(matrices[i].enhanced, matches, route.traverses[i].name, kSide_px, matrices[i].shrink);
    vo::write_file(folder / fmt::format("cost_matrix{}.png", suffix),
                   {reinterpret_cast<const char*>(png.data()), png.size()});
    if (!whole) continue;
    vo::write_file(folder / fmt::format("D{}.csv", suffix), matrix_csv(matrices[i].cost));
    vo::write_file(folder / fmt::format("DD{}.csv", suffix), matrix_csv(matrices[i].enhanced));
  }
}

const std::vector<std::string> kTrajectoryFiles{"trajectory.tum", "trajectory_odometry.tum", "trajectory.csv",
                                                "trajectory.geojson", "trajectory.gpx"};

/// The trajectory's files, into `folder`.
void put_trajectory(const place::QueryTrajectory& t, const place::Route& route,
                    const std::vector<place::Match>& matches, const fs::path& folder,
                    std::optional<double> start_utc_s) {
  if (!t.why_not.empty()) {
    const vo::Trajectory poses = matched_poses(matches, route, false).poses;
    const std::string comment =
        poses.empty() ? fmt::format("no pose: {}", t.why_not)
                      : fmt::format("query time, pose of the matched reference keyframe: {}", t.why_not);
    vo::write_file(folder / "trajectory.tum", vo::to_tum(poses, comment));
    write_geographic(folder, matched_poses(matches, route, true), route, start_utc_s);
    return;
  }
  const vo::Trajectory corrected = without_covariance(t.corrected);
  vo::write_file(
      folder / "trajectory.tum",
      vo::to_tum(corrected, "query time, corrected pose of each query keyframe in the route's coordinates"));
  vo::write_file(folder / "trajectory_odometry.tum",
                 vo::to_tum(t.odometry, "the same before correction, laid where the corrected one begins"));
  vo::write_file(folder / "trajectory.csv", trajectory_csv(t, matches));
  if (!route.traverses[*t.traverse].surveyed) return;
  SurePoses sure{.poses = corrected, .probability = {}};
  for (const place::Match& match : matches) sure.probability.push_back(match.probability);
  write_geographic(folder, sure, route, start_utc_s);
}

}  // namespace

const std::vector<std::string> kRunFiles{"matches.csv",    "trajectory.tum", "trajectory_odometry.tum",
                                         "trajectory.csv", "summary.json",   "report.html",
                                         kRunDataFile,     "config.toml"};

WrittenRun localise_into(const fs::path& folder, const place::Route& route, const std::string& route_path,
                         const vo::Walk& walk, const place::Settings& settings, bool whole_matrices,
                         const StoredRun* stored) {
  MatrixKeeper keeper(route, whole_matrices);
  std::optional<place::StoredSearch> search;
  if (stored != nullptr) search.emplace(route_path, *stored->team, stored->memory_bytes, std::ref(keeper));
  place::Run run = place::localise(route, walk, settings, std::ref(keeper), search ? &*search : nullptr);
  ordered_json shards = ordered_json::array();
  if (search) {
    search->finish();
    const LaunchedTeam* const launched = stored->launched;
    shards = shards_of_team(*stored->team, keeper, search->bytes_read(),
                            launched != nullptr ? launched->bytes_sent() : 0);
    read_matched_previews(route_path, run.matches, *stored->route);
  }
  for (const std::string& warning : run.sampled.warnings) spdlog::warn("{}", warning);
  for (const std::string& warning : run.warnings) spdlog::warn("{}", warning);
  if (run.settings.accept_probability && run.probability_source == place::ProbabilitySource::kNone)
    spdlog::warn("no probabilities: fewer than {} matches to learn from; accepted by their score",
                 place::kFewestScores);
  if (!run.drift.why_not.empty() && place::has_poses(route) && run.settings.correct_drift.value_or(false))
    spdlog::warn("drift is not corrected, trajectory.tum holds poses of matched places: {}",
                 run.drift.why_not);
  ordered_json about = summary(route, route_path, walk, run);
  about["processes"] = stored != nullptr ? stored->team->size() : 1;
  if (shards.size() > 1) about["shards"] = std::move(shards);
  std::string text = json_text(about, 2) + "\n";
  StagedFiles staged(folder);
  vo::write_file(staged.path() / "matches.csv", place::to_csv(run.matches));
  put_trajectory(run.drift, route, run.matches, staged.path(), walk.start_utc_s);
  vo::write_file(staged.path() / "summary.json", text);
  vo::write_file(staged.path() / "config.toml", to_toml(run.settings));
  const ordered_json data = run_data(route, walk, run, keeper.matrices());
  vo::write_file(staged.path() / kRunDataFile, json_text(data));
  vo::write_file(staged.path() / "report.html", run_report(staged.path(), data));
  write_matrices(staged.path(), keeper.matrices(), route, run.matches, whole_matrices);
  std::vector<std::string> stale{"metrics.json", "pr.csv", "errors.csv"};  // of other matches
  for (std::size_t i = 0; i == 0 || fs::exists(folder / fmt::format("cost_matrix-{}.png", i + 1)); ++i) {
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1);
    for (const char* name : {"cost_matrix{}.png", "D{}.csv", "DD{}.csv"})
      stale.push_back(fmt::format(fmt::runtime(name), suffix));
  }
  stale.insert(stale.end(), kRunFiles.begin(), kRunFiles.end());
  stale.insert(stale.end(), kTrajectoryFiles.begin(), kTrajectoryFiles.end());
  staged.commit(stale);
  return {std::move(run), keeper.matrices(), std::move(text)};
}

void write_trajectory(const place::QueryTrajectory& t, const place::Route& route,
                      const std::vector<place::Match>& matches, const fs::path& folder,
                      std::optional<double> start_utc_s) {
  StagedFiles staged(folder);
  put_trajectory(t, route, matches, staged.path(), start_utc_s);
  staged.commit(kTrajectoryFiles);
}

}  // namespace retrace
