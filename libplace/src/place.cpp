#include "place/place.hpp"

#include "place/certainty/not_found.hpp"
#include "place/match/nearest_place.hpp"
#include "place/match/verify_matches.hpp"
#include "place/match/walk_gaps.hpp"
#include "place/route/motion_choice.hpp"
#include "place/route/survey.hpp"
#include "place/stage_options.hpp"
#include "place/trajectory/pose_fixes.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <vo/base/error.hpp>
#include <vo/io/pose_series_io.hpp>

namespace place {
namespace {

vo::Walk read_as(std::span<const std::string> sources, const StageOptions& options,
                 const vo::ProgressCallback& progress) {
  vo::Walk walk = vo::read_walk(sources, options.walk, progress);
  if (options.motion_file.empty()) return walk;
  const vo::PoseSeries series = vo::read_pose_series(options.motion_file, options.motion_file_form);
  walk.track = vo::external_trajectory(series, walk.time_s, options.motion_file_fit);
  walk.warnings.insert(walk.warnings.end(), series.warnings.begin(), series.warnings.end());
  return walk;
}

/// Keyframes of a walk that was read for another route cannot be compared with anything.
void check_read_with(const StageOptions& options, const vo::Walk& walk) {
  const bool same_size = walk.thumbnails.width == options.walk.thumbnail.width &&
                         walk.thumbnails.height == options.walk.thumbnail.height;
  const bool tracked = !options.walk.track_features || walk.tracked.size() == walk.frames();
  const bool recorded =
      options.walk.recorders.empty() || walk.records.size() == options.walk.recorders.size();
  if (!same_size || !tracked || !recorded)
    throw std::invalid_argument("a walk read with the route's settings expected: place::read");
}

/// The walk's odometry at its keyframes; none, with the reason, if it has none.
vo::Trajectory odometry_at_keyframes(const vo::Walk& walk, const Run& run, const StageOptions& options,
                                     std::string& why_not) {
  vo::Trajectory nodes;
  try {
    vo::Trajectory trajectory = run.sampled.trajectory;
    if (trajectory.empty()) {
      vo::PedestrianMotion motion = vo::pedestrian_motion(walk, options.sampling.motion.pedestrian);
      if (motion.detection.steps.empty()) {
        why_not = fmt::format("{} shows no steps", walk.source);
        return {};
      }
      trajectory = std::move(motion.trajectory.at_frame);
    }
    for (const std::size_t frame : run.sampled.frames) nodes.push_back(trajectory[frame]);
  } catch (const vo::Error& error) {
    why_not = error.what();
  }
  return nodes;
}

QueryTrajectory corrected(const Route& route, const vo::Walk& walk, const Run& run,
                          const StageOptions& options) {
  std::string why_not;
  if (!has_poses(route)) {
    why_not = "the route has no poses; a survey of its walk, or motion by steps, gives it some";
  } else if (!run.settings.correct_drift.value_or(false)) {
    why_not = "correct-drift is false";
  } else {
    const vo::Trajectory odometry = odometry_at_keyframes(walk, run, options, why_not);
    if (why_not.empty())
      return query_trajectory(route, run.matches, odometry, gaps_at(run.sampled.frames, walk.time_s));
  }
  QueryTrajectory none;
  none.why_not = std::move(why_not);
  none.fixes = pose_fixes(route, run.matches).fixes;
  return none;
}

/// A route's settings with those of motion and odometry that its first walk settled.
Settings with_motion_of(Settings route, const Settings& walk) {
  for (const Setting& setting : settings_table()) {
    if (setting.of_route == OfRoute::kNo) continue;
    if (setting.group != SettingGroup::kMotion && setting.group != SettingGroup::kOdometry) continue;
    const std::optional<std::string> value = text_of(walk, setting);
    if (value) {
      set(route, setting, *value);
    } else {
      reset(route, setting);
    }
  }
  return route;
}

vo::Trajectory poses_of(const CorrectedWalk& walk) {
  vo::Trajectory trajectory;
  for (const UncertainPose& pose : walk.poses) trajectory.push_back({pose.time_s, pose.pose});
  return trajectory;
}

}  // namespace

Route new_route(const Settings& settings) {
  Route route;
  route.settings = kept_by_route(settings, resolve(settings, {.purpose = Purpose::kRoute}));
  return route;
}

vo::Walk read(const std::string& source, const Settings& settings, const vo::ProgressCallback& progress) {
  return read(std::span(&source, 1), settings, progress);
}

vo::Walk read(std::span<const std::string> sources, const Settings& settings,
              const vo::ProgressCallback& progress) {
  return read_as(sources, stage_options(resolve(settings, {.purpose = Purpose::kRoute})), progress);
}

vo::Walk read(const std::string& source, const Route& route, const Settings& settings,
              const vo::ProgressCallback& progress) {
  return read(std::span(&source, 1), route, settings, progress);
}

vo::Walk read(std::span<const std::string> sources, const Route& route, const Settings& settings,
              const vo::ProgressCallback& progress) {
  const ResolveContext context = on_route(route);
  const Settings resolved = resolve(settings, context);
  const StageOptions options = stage_options(resolved, follows_steps(resolved, context));
  return read_as(sources, options, progress);
}

AddedTraverse add(Route& route, const std::string& name, const vo::Walk& walk,
                  const std::optional<Survey>& survey, const Settings& settings, bool replace) {
  auto& traverses = route.traverses;
  const auto old = std::ranges::find(traverses, name, &Traverse::name);
  if (old != traverses.end() && !replace)
    throw vo::Error(name, "is a traverse of the route already", "another name");
  Settings resolved = resolve(settings, on_route(route, Purpose::kRoute));
  StageOptions options = stage_options(resolved);
  check_read_with(options, walk);
  std::optional<double> gait_share;
  if (resolved.motion == "auto") {
    const MotionChoice choice = choose_motion(resolved, walk, options.sampling.motion.pedestrian);
    resolved = choice.settings;
    options = stage_options(resolved);
    gait_share = choice.gait_share;
  }
  // A route's unit comes from its first traverse; a walk that replaces it is tied to the replaced one.
  const SampledWalk sampled = sample_walk(walk, options.sampling, &route);
  if (sampled.frames.size() < 2)
    throw vo::Error(walk.source, "gives a single keyframe",
                    "a longer walk, or a smaller sampling-n or every");
  Traverse traverse =
      make_traverse(name, walk, sampled, survey ? survey : survey_from_odometry(sampled.trajectory));
  traverse.settings = resolved;
  traverse.settings.threads.reset();  // makes no difference, and the file none
  if (traverses.empty()) {
    route.metric = sampled.metric;
    route.unit = sampled.unit;
    route.learned = sampled.learned;
    if (gait_share) route.settings = with_motion_of(route.settings, resolved);
  }
  AddedTraverse added{static_cast<std::size_t>(old - traverses.begin()), sampled.scale, gait_share,
                      sampled.warnings};
  if (old == traverses.end()) {
    traverses.push_back(std::move(traverse));
  } else {
    *old = std::move(traverse);
  }
  return added;
}

Run localise(const Route& route, const vo::Walk& walk, const Settings& settings,
             const SearchCallback& callback, TraverseSearch* search) {
  const ResolveContext context = on_route(route);
  Run run;
  run.settings = resolve(settings, context);
  StageOptions options = stage_options(run.settings, follows_steps(run.settings, context));
  if (search != nullptr) {
    search->prepare(run.settings, route);
    options.sampling.scale_costs = [search](std::size_t traverse, const Descriptors& query) {
      return search->scale_costs(traverse, query);
    };
    options.matching.traverse_search = search;
  }
  check_read_with(options, walk);
  run.sampled = sample_walk(walk, options.sampling, &route);
  RouteMatches found = match_on_route(route, walk.time_s, run.sampled, options.matching, callback);
  run.matches = std::move(found.matches);
  run.sequence_length = found.sequence_length;
  run.lines = found.lines;
  run.probability_source = found.probability_source;
  run.wrong_share = found.wrong_share;
  run.looked_at = found.looked_at;
  run.warnings = std::move(found.warnings);
  if (const std::optional<std::string> warning = not_found(walk.source, run.matches))
    run.warnings.push_back(*warning);
  if (options.verify > 0)
    verify_matches(route, run.sampled.view_points, {.places = options.verify}, run.matches);
  name_places(run.matches, route);
  run.drift = corrected(route, walk, run, options);
  if (run.drift.why_not.empty()) run.trajectory = poses_of(run.drift.corrected);
  return run;
}

RunEvaluation evaluate(const Run& run, const GroundTruth& truth, const Tolerance& tolerance) {
  return evaluate(std::span<const Match>(run.matches), truth, tolerance);
}

}  // namespace place
