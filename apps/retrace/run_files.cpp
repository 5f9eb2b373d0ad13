#include "run_files.hpp"

#include "json_file.hpp"
#include "report/kept_matrices.hpp"
#include "report/matrix_picture.hpp"
#include "report/run_data.hpp"
#include "report/run_report.hpp"
#include "run_directory.hpp"
#include "settings_file.hpp"
#include "stored_run.hpp"
#include "trajectory_files.hpp"
#include "walk_reading.hpp"

#include <functional>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <place/match/match_io.hpp>
#include <place/match/stored_search.hpp>
#include <place/match/walk_gaps.hpp>
#include <place/version.hpp>
#include <vo/io/atomic_file.hpp>

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

}  // namespace

const std::vector<std::string> kRunFiles{"matches.csv",    "trajectory.tum", "trajectory_odometry.tum",
                                         "trajectory.csv", "summary.json",   "report.html",
                                         kRunDataFile,     "config.toml"};

WrittenRun localise_into(const fs::path& folder, place::Route& route, const std::string& route_path,
                         const vo::Walk& walk, const place::Settings& settings, bool whole_matrices,
                         const StoredRun* stored) {
  MatrixKeeper keeper(route, whole_matrices);
  place::Alone alone;
  place::Team& team =
      stored != nullptr && stored->team != nullptr ? static_cast<place::Team&>(*stored->team) : alone;
  std::optional<place::StoredSearch> search;
  if (stored != nullptr) search.emplace(route_path, team, stored->memory_bytes, std::ref(keeper));
  place::Run run = place::localise(route, walk, settings, std::ref(keeper), search ? &*search : nullptr);
  ordered_json shards = ordered_json::array();
  if (search) {
    search->finish();
    shards = shards_of_team(team, keeper, search->bytes_read(),
                            stored->team != nullptr ? stored->team->bytes_sent() : 0);
    read_matched_previews(route_path, run.matches, route);
  }
  log_warnings(run.sampled.warnings);
  log_warnings(run.warnings);
  if (run.settings.accept_probability && run.probability_source == place::ProbabilitySource::kNone)
    spdlog::warn("no probabilities: fewer than {} matches to learn from; accepted by their score",
                 place::kFewestScores);
  if (!run.drift.why_not.empty() && place::has_poses(route) && run.settings.correct_drift.value_or(false))
    spdlog::warn("drift is not corrected, trajectory.tum holds poses of matched places: {}",
                 run.drift.why_not);
  ordered_json about = summary(route, route_path, walk, run);
  about["processes"] = team.size();
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
  // Of other matches, and of `retrace follow`.
  std::vector<std::string> stale{"metrics.json", "pr.csv", "errors.csv", "follow.jsonl", "evaluation.html"};
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

}  // namespace retrace
