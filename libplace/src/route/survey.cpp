#include "place/route/survey.hpp"

#include "place/route/geographic.hpp"

#include <cmath>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/trajectory_io.hpp>

namespace place {
namespace {

/// The poses of a trajectory at the walk's frames.
Survey survey_of(const vo::Trajectory& trajectory, const std::filesystem::path& path, const vo::Walk& walk) {
  // A pose may lie up to a frame before the first or after the last.
  const double tolerance_s = walk.time_s.back() / static_cast<double>(walk.frames() - 1);
  Survey survey{.source = path.filename().string(), .surveyed = true, .pose = {}, .distance_m = {}};
  std::optional<vo::Pose2> before;
  double travelled_m = 0;
  for (const double time_s : walk.time_s) {
    const std::optional<vo::Pose2> pose = vo::pose_at(trajectory, time_s, tolerance_s);
    if (pose && before) travelled_m += std::hypot(pose->x_m - before->x_m, pose->y_m - before->y_m);
    if (pose) before = pose;
    survey.pose.push_back(pose);
    survey.distance_m.push_back(pose ? std::optional(travelled_m) : std::nullopt);
  }
  if (!before) {
    throw vo::Error(path.string(),
                    fmt::format("has poses from {:.3f} to {:.3f} s and none within the walk",
                                trajectory.front().time_s, trajectory.back().time_s),
                    fmt::format("times from 0 to {:.3f} s, since the first frame", walk.time_s.back()));
  }
  return survey;
}

}  // namespace

Survey survey_from_truth(const std::filesystem::path& path, const vo::Walk& walk) {
  const vo::WalkTruth truth = vo::read_truth(path);
  if (truth.frame.size() != walk.frames()) {
    throw vo::Error(path.string(), fmt::format("has {} rows", truth.frame.size()),
                    fmt::format("{}, one for each frame of {}", walk.frames(), walk.source));
  }
  Survey survey{.source = path.filename().string(), .surveyed = true, .pose = {}, .distance_m = {}};
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    survey.pose.emplace_back(truth.poses[i].pose);
    survey.distance_m.emplace_back(truth.distance_m[i]);
  }
  return survey;
}

Survey survey_from_trajectory(const std::filesystem::path& path, const vo::Walk& walk) {
  return survey_of(vo::read_tum(path), path, walk);
}

Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk,
                         std::optional<GeographicOrigin>& origin) {
  const GeographicTrack track = read_track(path);
  if (!origin) origin = {track.points.front().latitude_deg, track.points.front().longitude_deg};
  return survey_of(local_trajectory(track, *origin), path, walk);
}

std::optional<Survey> survey_from_odometry(const vo::Trajectory& odometry) {
  if (odometry.empty()) return std::nullopt;
  Survey survey{.source = "odometry", .surveyed = false, .pose = {}, .distance_m = {}};
  for (const vo::TimedPose& frame : odometry) survey.pose.emplace_back(frame.pose);
  survey.distance_m.resize(odometry.size());
  return survey;
}

}  // namespace place
