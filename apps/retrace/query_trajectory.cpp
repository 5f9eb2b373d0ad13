#include "query_trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <place/route/geographic.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>
#include <vo/io/trajectory_io.hpp>

namespace retrace {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// The walk's odometry at its keyframes; none, with the reason, if it has none.
vo::Trajectory odometry_at_keyframes(const vo::Walk& walk, const place::SampledWalk& sampled,
                                     const std::vector<place::Match>& matches, const Settings& settings,
                                     std::string& why_not) {
  vo::Trajectory nodes;
  try {
    vo::Trajectory trajectory = sampled.trajectory;
    if (trajectory.empty()) {
      vo::PedestrianMotion motion = vo::pedestrian_motion(walk, settings.sampling.motion.pedestrian);
      if (motion.detection.steps.empty()) {
        why_not = fmt::format("{} shows no steps", walk.source);
        return {};
      }
      trajectory = std::move(motion.trajectory.at_frame);
    }
    for (const place::Match& match : matches)
      nodes.push_back(trajectory[static_cast<std::size_t>(match.query_frame)]);
  } catch (const vo::Error& error) {
    why_not = error.what();
  }
  return nodes;
}

/// The trajectory moved as a whole, so that it begins at a pose.
vo::Trajectory laid_at(const vo::Pose2& begin, vo::Trajectory trajectory) {
  const vo::Pose2 from = trajectory.front().pose;
  const double turn = begin.heading_rad - from.heading_rad, s = std::sin(turn), c = std::cos(turn);
  for (auto& [time_s, pose] : trajectory) {
    const double x = pose.x_m - from.x_m, y = pose.y_m - from.y_m;
    pose = {begin.x_m + c * x + s * y, begin.y_m + c * y - s * x,
            vo::wrap_angle_rad(pose.heading_rad + turn)};
  }
  return trajectory;
}

/// Accepted matches' poses, at the query's times.
vo::Trajectory matched_poses(const std::vector<place::Match>& matches) {
  vo::Trajectory trajectory;
  for (const place::Match& match : matches)
    if (match.accepted && match.place->pose) trajectory.push_back({match.query_time_s, *match.place->pose});
  return trajectory;
}

vo::Trajectory without_covariance(const place::CorrectedWalk& walk) {
  vo::Trajectory trajectory;
  for (const place::UncertainPose& pose : walk.poses) trajectory.push_back({pose.time_s, pose.pose});
  return trajectory;
}

std::string trajectory_csv(const QueryTrajectory& t, const std::vector<place::Match>& matches) {
  std::string csv =
      "query_frame,time_s,x_m,y_m,heading_deg,cov_xx_m2,cov_xy_m2,cov_yy_m2,heading_sd_deg,distance_m,"
      "lateral_m,step_scale,turn_scale,match_weight\n";
  std::vector<std::string> weight(matches.size());
  for (std::size_t i = 0; i < t.fixes.size(); ++i)
    weight[t.fixes[i].node] = fmt::format("{:.4f}", t.corrected.fix_weight[i]);
  for (std::size_t i = 0; i < t.corrected.poses.size(); ++i) {
    const auto& [time_s, pose, covariance] = t.corrected.poses[i];
    csv += fmt::format(
        "{},{:.6f},{:.6f},{:.6f},{:.6f},{:.9g},{:.9g},{:.9g},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{}\n",
        matches[i].query_frame, time_s, pose.x_m, pose.y_m, pose.heading_rad * kDegrees, covariance[0],
        covariance[1], covariance[4], std::sqrt(covariance[8]) * kDegrees, t.on_route[i].distance_m,
        t.on_route[i].right_m, t.corrected.step_scale[i], t.corrected.turn_scale[i], weight[i]);
  }
  return csv;
}

}  // namespace

bool has_poses(const place::Route& route) {
  return std::ranges::any_of(route.traverses, [](const place::Traverse& traverse) {
    return std::ranges::any_of(traverse.keyframes,
                               [](const auto& keyframe) { return keyframe.pose.has_value(); });
  });
}

std::size_t matches_believed(const QueryTrajectory& trajectory) {
  constexpr double kHalf = 0.5;  // of its weight gone, a match is let go
  return static_cast<std::size_t>(
      std::ranges::count_if(trajectory.corrected.fix_weight, [](double weight) { return weight >= kHalf; }));
}

QueryTrajectory query_trajectory(const place::Route& route, const vo::Walk& walk,
                                 const place::SampledWalk& sampled, const std::vector<place::Match>& matches,
                                 const Settings& settings) {
  QueryTrajectory t;
  t.fixes = place::pose_fixes(route, matches).fixes;
  t.asked_for = settings.correct_drift && !walk.tracked.empty();
  if (!has_poses(route)) {
    t.why_not =
        "the route has no poses (build it with --truth, --trajectory or --track, or with --motion steps)";
  } else if (!t.asked_for) {
    t.why_not = "--correct-drift is false";
  } else {
    const vo::Trajectory odometry = odometry_at_keyframes(walk, sampled, matches, settings, t.why_not);
    if (t.why_not.empty()) return query_trajectory(route, matches, odometry);
  }
  return t;
}

QueryTrajectory query_trajectory(const place::Route& route, const std::vector<place::Match>& matches,
                                 const vo::Trajectory& odometry) {
  place::RouteFixes fixes = place::pose_fixes(route, matches);
  QueryTrajectory t;
  t.traverse = fixes.traverse;
  t.fixes = std::move(fixes.fixes);
  if (!t.fixes.empty()) t.corrected = place::correct_drift(odometry, t.fixes);
  if (t.corrected.status != place::DriftStatus::kCorrected) {
    t.why_not = "fewer than three accepted matches agree with the walk between them";
    return t;
  }
  // With three of ten matches replaced by random ones three of five or more still agree, and the trajectory
  // is right; of random ones alone a twentieth do.
  if (const std::size_t believed = matches_believed(t); 3 * believed < t.fixes.size()) {
    t.why_not = fmt::format("only {} of {} accepted matches agree with the walk's steps and turns", believed,
                            t.fixes.size());
    return t;
  }
  t.odometry = laid_at(t.corrected.poses.front().pose, odometry);
  std::vector<vo::Pose2> poses;
  for (const place::UncertainPose& pose : t.corrected.poses) poses.push_back(pose.pose);
  t.on_route = place::positions_on_route(route.traverses[*t.traverse], poses);
  return t;
}

void write_trajectory(const QueryTrajectory& t, const place::Route& route,
                      const std::vector<place::Match>& matches, const std::filesystem::path& folder) {
  for (const char* name :
       {"trajectory_odometry.tum", "trajectory.csv", "trajectory.geojson", "trajectory.gpx"})
    std::filesystem::remove(folder / name);
  if (!t.why_not.empty()) {
    const std::string comment =
        t.fixes.empty() ? fmt::format("no pose: {}", t.why_not)
                        : fmt::format("query time, pose of the matched reference keyframe: {}", t.why_not);
    vo::write_file(folder / "trajectory.tum", vo::to_tum(matched_poses(matches), comment));
    return;
  }
  const vo::Trajectory corrected = without_covariance(t.corrected);
  vo::write_file(
      folder / "trajectory.tum",
      vo::to_tum(corrected, "query time, corrected pose of each query keyframe in the route's coordinates"));
  vo::write_file(folder / "trajectory_odometry.tum",
                 vo::to_tum(t.odometry, "the same before correction, laid where the corrected one begins"));
  vo::write_file(folder / "trajectory.csv", trajectory_csv(t, matches));
  if (!route.origin || !route.traverses[*t.traverse].surveyed) return;
  vo::write_file(folder / "trajectory.geojson", place::to_geojson(corrected, *route.origin));
  vo::write_file(folder / "trajectory.gpx", place::to_gpx(corrected, *route.origin));
}

}  // namespace retrace
