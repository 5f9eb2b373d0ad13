#include "command.hpp"
#include "run_directory.hpp"
#include "run_summary.hpp"
#include "trajectory_files.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <place/match/match_io.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

struct CorrectOptions {
  std::string folder;  ///< written by `retrace localise`
  std::string route;
  std::string odometry;
};

void correct(const CorrectOptions& options) {
  const fs::path folder = options.folder;
  check_written_by("localise", folder);
  const place::Route route = place::read_route(options.route, {.previews = false});
  std::vector<place::Match> matches = place::read_matches(folder / "matches.csv");
  place::locate(matches, route);
  const fs::path path =
      options.odometry.empty() ? folder / "trajectory_odometry.tum" : fs::path(options.odometry);
  const vo::Trajectory trajectory = vo::read_tum(path);
  const RunSummary summary = read_run_summary(folder);
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
  const place::QueryTrajectory corrected =
      place::query_trajectory(route, matches, nodes, gaps_of(summary, matches));
  if (!corrected.why_not.empty())
    throw vo::Error((folder / "matches.csv").string(), "gives no trajectory", corrected.why_not);
  write_trajectory(corrected, route, matches, folder, summary.query_start_utc_s);
  fmt::print("{}: {} poses from {} matches; see {}\n", options.folder, corrected.corrected.poses.size(),
             corrected.fixes.size(), (folder / "trajectory.csv").string());
}

}  // namespace

std::function<void()> declare_correct(Arguments& arguments) {
  auto options = std::make_shared<CorrectOptions>();
  arguments.positional("run", options->folder, "folder written by `retrace localise`");
  arguments.option("--route", options->route, "route database of the run").required();
  arguments.option(
      "--odometry", options->odometry,
      "another trajectory of the walk, TUM format, seconds since its first frame [the run's own]");
  arguments.footer(
      "Writes trajectory.tum, trajectory_odometry.tum and trajectory.csv anew.\n"
      "Example:\n"
      "  retrace correct run --route route.db --odometry phone.tum");
  return [options] { correct(*options); };
}

}  // namespace retrace
