#include "place/route/survey.hpp"

#include "place/route/track.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/base/median.hpp>
#include <vo/io/trajectory_io.hpp>

namespace place {
namespace {

/// A survey's path and its clock.
struct TimedPath {
  std::filesystem::path file;
  vo::Trajectory poses;
  std::vector<std::size_t> segment;   ///< of each pose; nothing is known between two of them
  std::optional<double> start_utc_s;  ///< seconds since 1970 at time 0
  std::vector<std::string> warnings;
};

double duration_s(const vo::Walk& walk) {
  return walk.time_s.back();
}

/// Begins a new segment after every gap longer than the limit.
void split_at_gaps(TimedPath& path, const SurveyOptions& options, double least_gap_s) {
  if (options.max_gap_s && !(*options.max_gap_s > 0))
    throw std::invalid_argument("survey: max_gap_s above 0 expected");
  std::vector<double> step_s;
  for (std::size_t i = 1; i < path.poses.size(); ++i)
    step_s.push_back(path.poses[i].time_s - path.poses[i - 1].time_s);
  if (step_s.empty()) return;
  const double limit_s = options.max_gap_s.value_or(std::max(least_gap_s, 3 * vo::median(step_s)));
  path.segment.resize(path.poses.size(), 0);
  std::vector<std::size_t> split(path.poses.size(), 0);
  for (std::size_t i = 1; i < split.size(); ++i) {
    const bool apart = step_s[i - 1] > limit_s || path.segment[i] != path.segment[i - 1];
    split[i] = split[i - 1] + (apart ? 1 : 0);
  }
  path.segment = std::move(split);
}

/// Time on the path's clock at the walk's first frame.
double start_s(TimedPath& path, const vo::Walk& walk, const SurveyOptions& options) {
  if (options.start_s) return *options.start_s;
  const double begin_s = path.poses.front().time_s, end_s = path.poses.back().time_s;
  if (path.start_utc_s && walk.start_utc_s) {
    const double at_s = *walk.start_utc_s - *path.start_utc_s;
    const double common_s = std::min(end_s, at_s + duration_s(walk)) - std::max(begin_s, at_s);
    if (2 * common_s >= duration_s(walk)) {
      path.warnings.push_back(fmt::format(
          "{}: matched with the video by its creation time: the first frame is {:.1f} s after the "
          "file's first pose",
          path.file.string(), at_s - begin_s));
      return at_s;
    }
    path.warnings.push_back(
        fmt::format("{}: was not recorded at the video's creation time; it is taken to begin with the video",
                    path.file.string()));
  }
  constexpr double kMuch = 1.5, kAlways_s = 10;  // for a logger started and stopped by hand
  if (end_s > kMuch * duration_s(walk) + kAlways_s) {
    path.warnings.push_back(fmt::format(
        "{}: lasts {:.0f} s, the video {:.0f} s; it is taken to begin with the video (--track-start-s or "
        "--trajectory-start-s say otherwise)",
        path.file.string(), end_s, duration_s(walk)));
  }
  return 0;
}

/// The pose at a time: between two poses of one segment, or the nearest one within the tolerance.
std::optional<vo::Pose2> pose_at(const TimedPath& path, double time_s, double tolerance_s) {
  const auto after = std::ranges::lower_bound(path.poses, time_s, {}, &vo::TimedPose::time_s);
  const auto index = static_cast<std::size_t>(after - path.poses.begin());
  const bool has_after = after != path.poses.end(), has_before = index > 0;
  if (has_after && has_before && path.segment[index - 1] == path.segment[index])
    return vo::pose_at({path.poses[index - 1], *after}, time_s, 0);
  const double wait_s = has_after ? after->time_s - time_s : HUGE_VAL;
  const double since_s = has_before ? time_s - path.poses[index - 1].time_s : HUGE_VAL;
  if (std::min(wait_s, since_s) > tolerance_s) return std::nullopt;
  return wait_s < since_s ? after->pose : path.poses[index - 1].pose;
}

/// The path's poses at the walk's frames.
Survey survey_of(TimedPath path, const vo::Walk& walk, const SurveyOptions& options) {
  const double offset_s = start_s(path, walk, options);
  path.segment.resize(path.poses.size(), 0);
  // A pose may lie up to a frame before the first or after the last.
  const double tolerance_s = duration_s(walk) / static_cast<double>(walk.frames() - 1);
  Survey survey{
      .source = (path.file.has_filename() ? path.file : path.file.parent_path()).filename().string(),
      .surveyed = true,
      .pose = {},
      .distance_m = {}};
  std::optional<vo::Pose2> before;
  double travelled_m = 0;
  for (const double time_s : walk.time_s) {
    const std::optional<vo::Pose2> pose = pose_at(path, offset_s + time_s, tolerance_s);
    if (pose && before) travelled_m += std::hypot(pose->x_m - before->x_m, pose->y_m - before->y_m);
    if (pose) before = pose;
    survey.pose.push_back(pose);
    survey.distance_m.push_back(pose ? std::optional(travelled_m) : std::nullopt);
  }
  if (!before) {
    throw vo::Error(path.file.string(),
                    fmt::format("has poses from {:.3f} to {:.3f} s and none within the walk",
                                path.poses.front().time_s, path.poses.back().time_s),
                    fmt::format("times from {:.3f} to {:.3f} s, since the first frame; or what its clock "
                                "shows at the first frame (--trajectory-start-s, --track-start-s)",
                                offset_s, offset_s + duration_s(walk)));
  }
  const auto posed = static_cast<std::size_t>(
      std::ranges::count_if(survey.pose, [](const auto& pose) { return pose.has_value(); }));
  if (2 * posed < walk.frames()) {
    path.warnings.push_back(fmt::format("{}: has poses at {} of {} frames; the others have none",
                                        path.file.string(), posed, walk.frames()));
  }
  survey.warnings = std::move(path.warnings);
  return survey;
}

/// A series without times: one pose for each frame.
void take_times_of_frames(vo::PoseSeries& series, const vo::Walk& walk) {
  if (series.frames != walk.frames()) {
    throw vo::Error(series.source, fmt::format("has {} poses without times", series.frames),
                    fmt::format("{}, one for each frame of {}", walk.frames(), walk.source));
  }
  for (const std::size_t frame : series.frame) series.time_s.push_back(walk.time_s[frame]);
}

}  // namespace

Survey survey_from_truth(const std::filesystem::path& path, const vo::Walk& walk) {
  const vo::WalkTruth truth = vo::read_truth(path);
  if (truth.frame.size() != walk.frames()) {
    throw vo::Error(path.string(), fmt::format("has {} rows", truth.frame.size()),
                    fmt::format("{}, one for each frame of {}", walk.frames(), walk.source));
  }
  constexpr double kOtherUnit = 100;  // times as long as the walk; slow motion is 8 times, at most
  const double length_s = truth.time_s.back() - truth.time_s.front();
  if (length_s > kOtherUnit * duration_s(walk)) {
    throw vo::Error(path.string(), fmt::format("has times over {:.10g} s", length_s),
                    fmt::format("seconds: {} lasts {:.3f} s", walk.source, duration_s(walk)));
  }
  Survey survey{.source = path.filename().string(), .surveyed = true, .pose = {}, .distance_m = {}};
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    survey.pose.push_back(truth.pose[i]);
    survey.distance_m.push_back(truth.distance_m[i]);
  }
  const auto known = [](const auto& value) { return value.has_value(); };
  if (std::ranges::none_of(survey.pose, known) && std::ranges::none_of(survey.distance_m, known))
    throw vo::Error(path.string(), "knows neither a pose nor a distance", "those of the walk's frames");
  return survey;
}

Survey survey_from_trajectory(const std::filesystem::path& path, const vo::Walk& walk,
                              const SurveyOptions& options) {
  vo::PoseSeries series = vo::read_pose_series(path, {.axes = options.axes});
  const bool timed = !series.time_s.empty();
  if (!timed) take_times_of_frames(series, walk);
  TimedPath timed_path{.file = path, .poses = vo::planar(series), .warnings = std::move(series.warnings)};
  constexpr double kSince1970_s = 1e9;  // a clock beyond this shows the date: 2001 and later
  if (timed_path.poses.front().time_s > kSince1970_s) timed_path.start_utc_s = 0;
  if (timed) split_at_gaps(timed_path, options, kTrajectoryGap_s);
  return survey_of(std::move(timed_path), walk, timed ? options : SurveyOptions{.start_s = 0});
}

Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk,
                         std::optional<GeographicOrigin>& origin, const SurveyOptions& options) {
  GeographicTrack track = read_track(path, {.track_name = options.track_name,
                                            .video_start_utc_s = walk.start_utc_s,
                                            .video_duration_s = duration_s(walk),
                                            .picture_time_s = walk.time_s});
  if (!origin) origin = {track.points.front().latitude_deg, track.points.front().longitude_deg};
  TimedPath timed_path{.file = path,
                       .poses = local_trajectory(track, *origin),
                       .segment = std::move(track.segment),
                       .start_utc_s = track.start_utc_s,
                       .warnings = std::move(track.warnings)};
  split_at_gaps(timed_path, options, kTrackGap_s);
  return survey_of(std::move(timed_path), walk, options);
}

Survey survey_from_track(const std::filesystem::path& path, const vo::Walk& walk, Route& route,
                         const SurveyOptions& options) {
  for (const Traverse& traverse : route.traverses) {
    if (!route.origin && traverse.surveyed && !traverse.pose_source.empty()) {
      throw vo::Error(
          path.string(),
          fmt::format("is geographic, and the route has poses of {} that are not", traverse.pose_source),
          "a truth or trajectory in the same coordinates, or another route");
    }
  }
  return survey_from_track(path, walk, route.origin, options);
}

std::optional<Survey> survey_from_odometry(const vo::Trajectory& odometry) {
  if (odometry.empty()) return std::nullopt;
  Survey survey{.source = "odometry", .surveyed = false, .pose = {}, .distance_m = {}};
  for (const vo::TimedPose& frame : odometry) survey.pose.emplace_back(frame.pose);
  survey.distance_m.resize(odometry.size());
  return survey;
}

}  // namespace place
