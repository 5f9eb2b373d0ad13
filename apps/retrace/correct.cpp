#include "command.hpp"
#include "query_trajectory.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

struct CorrectOptions {
  std::string folder;  ///< written by `retrace localise`
  std::string route;
  std::string odometry;
};

/// The place of a matched frame: the traverse's keyframe of it.
place::Place place_of(const place::Route& route, const std::string& name, double frame,
                      const std::string& where) {
  const auto traverse = std::ranges::find(route.traverses, name, &place::Traverse::name);
  if (traverse == route.traverses.end())
    throw vo::Error(where, fmt::format("traverse '{}' is not on the route", name), "the route of the run");
  const auto keyframe =
      std::ranges::find(traverse->keyframes, static_cast<std::int64_t>(frame), &place::Keyframe::frame);
  if (keyframe == traverse->keyframes.end())
    throw vo::Error(where, fmt::format("frame {} is no keyframe of '{}'", frame, name),
                    "the route of the run");
  return {.traverse = name,
          .keyframe = static_cast<std::size_t>(keyframe - traverse->keyframes.begin()),
          .frame = keyframe->frame,
          .time_s = keyframe->time_s,
          .distance_m = keyframe->distance_m,
          .pose = keyframe->pose};
}

std::vector<place::Match> read_matches(const fs::path& path, const place::Route& route) {
  const vo::CsvTable table = vo::CsvTable::read(path);
  const auto query_frame = table.indices("query_frame"), accepted = table.indices("accepted");
  const auto query_time_s = table.numbers("query_time_s"), score = table.numbers("score");
  const auto traverse = table.text("traverse");
  const auto frame = table.optional_numbers("reference_frame");
  std::vector<place::Match> matches;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    place::Match match{.query_frame = query_frame[i], .query_time_s = query_time_s[i]};
    if (frame[i]) {
      match.place = place_of(route, traverse[i], *frame[i], table.where(i));
      match.score = score[i];
      match.accepted = accepted[i] != 0;
    }
    matches.push_back(std::move(match));
  }
  return matches;
}

void correct(const CorrectOptions& options) {
  const fs::path folder = options.folder;
  if (!fs::is_directory(folder))
    throw vo::Error(options.folder, "is no folder", "one written by `retrace localise`");
  const place::Route route = place::read_route(options.route, {.previews = false});
  const std::vector<place::Match> matches = read_matches(folder / "matches.csv", route);
  const fs::path path =
      options.odometry.empty() ? folder / "trajectory_odometry.tum" : fs::path(options.odometry);
  const vo::Trajectory trajectory = vo::read_tum(path);
  vo::Trajectory nodes;
  for (const place::Match& match : matches) {
    constexpr double kClock_s = 0.05;  // about a frame
    const auto pose = vo::pose_at(trajectory, match.query_time_s, kClock_s);
    if (!pose) {
      throw vo::Error(path.string(), fmt::format("has no pose at {:.3f} s", match.query_time_s),
                      "odometry of the whole walk, seconds since its first frame");
    }
    nodes.push_back({match.query_time_s, *pose});
  }
  const QueryTrajectory corrected = query_trajectory(route, matches, nodes);
  if (!corrected.why_not.empty())
    throw vo::Error((folder / "matches.csv").string(), "gives no trajectory", corrected.why_not);
  write_trajectory(corrected, route, matches, folder);
  fmt::print("{}: {} poses from {} matches; see {}\n", options.folder, corrected.corrected.poses.size(),
             corrected.fixes.size(), (folder / "trajectory.csv").string());
}

}  // namespace

Command add_correct(CLI::App& root) {
  auto options = std::make_shared<CorrectOptions>();
  CLI::App* app = root.add_subcommand(
      "correct",
      "the corrected trajectory of a run again, after its matches were edited or from other odometry");
  app->add_option("run", options->folder, "folder written by `retrace localise`")->required();
  app->add_option("--route", options->route, "route database of the run")->required();
  app->add_option(
      "--odometry", options->odometry,
      "another trajectory of the walk, TUM format, seconds since its first frame [the run's own]");
  app->footer(
      "Writes trajectory.tum, trajectory_odometry.tum and trajectory.csv anew.\n"
      "Example:\n"
      "  retrace correct run --route route.db --odometry phone.tum");
  return {app, [options] { correct(*options); }};
}

}  // namespace retrace
