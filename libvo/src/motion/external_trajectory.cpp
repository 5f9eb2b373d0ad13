#include "vo/motion/external_trajectory.hpp"

#include "vo/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

/// The pose of a frame in a series without times.
std::optional<Pose3> pose_of_frame(const PoseSeries& series, std::size_t frame) {
  const auto found = std::ranges::lower_bound(series.frame, frame);
  if (found == series.frame.end() || *found != frame) return std::nullopt;
  return series.poses[static_cast<std::size_t>(found - series.frame.begin())];
}

std::optional<Pose3> pose_at(const PoseSeries& series, double time_s,
                             const ExternalTrajectoryOptions& options) {
  const auto after = std::ranges::lower_bound(series.time_s, time_s);
  const auto index = static_cast<std::size_t>(after - series.time_s.begin());
  const bool has_after = after != series.time_s.end(), has_before = index > 0;
  if (has_after && *after == time_s) return series.poses[index];
  const double wait_s = has_after ? *after - time_s : HUGE_VAL;
  const double since_s = has_before ? time_s - series.time_s[index - 1] : HUGE_VAL;
  if (wait_s + since_s <= options.max_gap_s)
    return interpolate(series.poses[index - 1], series.poses[index], since_s / (wait_s + since_s));
  if (std::min(wait_s, since_s) > options.time_tolerance_s) return std::nullopt;
  return wait_s < since_s ? series.poses[index] : series.poses[index - 1];
}

/// Clockwise from above, about the body's own vertical.
std::optional<double> turn_rad(const cv::Matx33d& from, const cv::Matx33d& to, BodyAxes axes) {
  const cv::Matx33d turn = from.t() * to;
  switch (axes) {
    case BodyAxes::kCamera:
      return std::atan2(turn(0, 2), turn(2, 2));
    case BodyAxes::kVehicle:
      return -std::atan2(turn(1, 0), turn(0, 0));
    case BodyAxes::kNone:
      break;
  }
  return std::nullopt;
}

void check(const PoseSeries& series, std::span<const double> time_s,
           const ExternalTrajectoryOptions& options) {
  if (!(options.time_tolerance_s >= 0) || !(options.max_gap_s >= 0) || !(options.relative_sigma >= 0))
    throw std::invalid_argument("external_trajectory: tolerances of 0 or more expected");
  if (series.time_s.empty() && series.frames != time_s.size()) {
    throw Error(series.source, fmt::format("has {} poses without times", series.frames),
                fmt::format("{}, one for each frame, or poses with times", time_s.size()));
  }
}

}  // namespace

DisplacementTrack external_trajectory(const PoseSeries& series, std::span<const double> time_s,
                                      const ExternalTrajectoryOptions& options) {
  check(series, time_s, options);
  DisplacementTrack track;
  track.scale = options.metric ? TrackScale::kMetric : TrackScale::kCommon;
  int segment = 0;
  bool any = false;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const std::optional<Pose3> pose = series.time_s.empty()
                                          ? pose_of_frame(series, i)
                                          : pose_at(series, options.start_s + time_s[i], options);
    const std::optional<Pose3> before = i > 0 ? track.poses[i - 1] : pose;
    const bool gap = i > 0 && time_s[i] - time_s[i - 1] > options.max_gap_s;
    if (pose && any && (!before || gap)) ++segment;
    any = any || pose;
    TrackedDisplacement frame{.valid = pose && before && !gap, .segment = segment};
    if (frame.valid) {
      frame.displacement = cv::norm(pose->position - before->position);
      frame.sigma = options.relative_sigma * frame.displacement;
      frame.turn_rad = turn_rad(before->rotation, pose->rotation, series.axes);
    } else {
      frame.loss = TrackLoss::kGap;
    }
    track.frames.push_back(frame);
    track.poses.push_back(pose);
  }
  if (!any && !time_s.empty()) {
    throw Error(
        series.source,
        fmt::format("has poses from {:.10g} to {:.10g} s, none at a frame of the walk ({:.10g} to {:.10g} s)",
                    series.time_s.empty() ? 0 : series.time_s.front(),
                    series.time_s.empty() ? 0 : series.time_s.back(), options.start_s + time_s.front(),
                    options.start_s + time_s.back()),
        "the walk's clock, or the file's time at its first frame");
  }
  // The first frame has no displacement. A caller who allows no gap at all wants poses only.
  const auto valid = std::ranges::count(track.frames, true, &TrackedDisplacement::valid);
  if (options.max_gap_s > 0 && time_s.size() > 1 && valid <= (track.frames[0].valid ? 1 : 0)) {
    throw Error(series.source, "has no two poses at neighbouring frames of the walk",
                fmt::format("poses and frames at most {} s apart", options.max_gap_s));
  }
  return track;
}

}  // namespace vo
