#include "trajectory_files.hpp"

#include "run_directory.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <place/route/geographic.hpp>
#include <vo/base/degrees.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/csv_columns.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

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

std::string six_digits(double value) {
  return fmt::format("{:.6f}", value);
}
std::string nine_digits(double value) {
  return fmt::format("{:.9g}", value);
}

using Row = TrajectoryRow;
constexpr std::array kTrajectoryColumns{
    vo::CsvColumn<Row>{"query_frame", [](const Row& r) { return fmt::format("{}", r.query_frame); }},
    vo::CsvColumn<Row>{"time_s", [](const Row& r) { return six_digits(r.pose.time_s); }},
    vo::CsvColumn<Row>{"x_m", [](const Row& r) { return six_digits(r.pose.pose.x_m); }},
    vo::CsvColumn<Row>{"y_m", [](const Row& r) { return six_digits(r.pose.pose.y_m); }},
    vo::CsvColumn<Row>{"heading_deg",
                       [](const Row& r) { return six_digits(r.pose.pose.heading_rad * vo::kDegPerRad); }},
    vo::CsvColumn<Row>{"cov_xx_m2", [](const Row& r) { return nine_digits(r.pose.covariance[0]); }},
    vo::CsvColumn<Row>{"cov_xy_m2", [](const Row& r) { return nine_digits(r.pose.covariance[1]); }},
    vo::CsvColumn<Row>{"cov_yy_m2", [](const Row& r) { return nine_digits(r.pose.covariance[4]); }},
    vo::CsvColumn<Row>{
        "heading_sd_deg",
        [](const Row& r) { return six_digits(std::sqrt(r.pose.covariance[8]) * vo::kDegPerRad); }},
    vo::CsvColumn<Row>{"distance_m", [](const Row& r) { return six_digits(r.on_route.distance_m); }},
    vo::CsvColumn<Row>{"lateral_m", [](const Row& r) { return six_digits(r.on_route.right_m); }},
    vo::CsvColumn<Row>{"step_scale", [](const Row& r) { return six_digits(r.step_scale); }},
    vo::CsvColumn<Row>{"turn_scale", [](const Row& r) { return six_digits(r.turn_scale); }},
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

}  // namespace

const std::vector<std::string> kTrajectoryFiles{"trajectory.tum", "trajectory_odometry.tum", "trajectory.csv",
                                                "trajectory.geojson", "trajectory.gpx"};

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

void write_trajectory(const place::QueryTrajectory& t, const place::Route& route,
                      const std::vector<place::Match>& matches, const fs::path& folder,
                      std::optional<double> start_utc_s) {
  StagedFiles staged(folder);
  put_trajectory(t, route, matches, staged.path(), start_utc_s);
  staged.commit(kTrajectoryFiles);
}

}  // namespace retrace
