#pragma once

#include "place/settings.hpp"

namespace place {

struct Route;

/// The purpose of settings: which groups count, and whether steps are tracked.
enum class Purpose {
  kRoute,     ///< a walk becomes a traverse: reading, motion, odometry
  kLocalise,  ///< a walk is found on a route: all groups
  kOdometry,  ///< steps and trajectory of a walk: reading, motion, odometry
};

/// Where settings are resolved.
struct ResolveContext {
  Purpose purpose = Purpose::kLocalise;
  const Settings* route = nullptr;  ///< of the route that the walk is on; null for a new route or none
  bool route_has_poses = false;     ///< then a query's steps are tracked, to correct their drift
  bool route_has_points = true;     ///< without them `verify` is refused
  bool drop_ineffective = false;  ///< drop settings without effect, not refuse them: for the cells of a sweep
};

/// The context of a walk on a route, which must outlive it.
ResolveContext on_route(const Route& route, Purpose purpose = Purpose::kLocalise);

/// All settings that have an effect, with their values, and no others: the given value, else the route's,
/// else the default. Resolving the result again changes nothing, so a saved result repeats the run.
///
/// - Values are in range (`check_ranges`).
/// - `OfRoute::kFixed` settings are the route's; another value is refused. Of `sampling-n` and `spacing-m`
///   the route's are used only if neither was given: each sets the density of keyframes.
/// - A query keeps the route's motion, or has none; another motion has another unit and is refused. `motion
///   auto` is the route's there; of a new route it stays until its first walk is added (`choose_motion`); of
///   odometry it is hybrid.
/// - A given setting without effect is refused (`has_effect`). Settings in groups that the purpose does not
///   use are ignored, so that one file of settings serves all commands; those of odometry have an effect if
///   steps are tracked.
/// - `spacing-m` is 0.85 unless `sampling-n` was given; `sampling-n` is 6 if the motion may turn out not to
///   be metric, unless only `spacing-m` was given.
/// - `accept-score` is 0.1 with `compat`; otherwise it has no value unless given, and `accept-probability`
///   counts.
/// - `verify` needs a route that keeps points of its keyframes.
/// - `v-min` and `v-max` come together, v-min <= v-max; `motion file` needs `motion-file`; `score ratio`
///   needs whole lines, `min-fraction 1`; `max-shift-px` is less than half of the thumbnail's width.
///
/// Throws `vo::Error` naming the setting, what is wrong, and what was expected.
Settings resolve(const Settings& given, const ResolveContext& context);

/// True if resolved settings require step tracking.
bool follows_steps(const Settings& settings, const ResolveContext& context);

/// The resolved settings that a route keeps for later walks: all but those specific to each walk.
Settings kept_by_route(const Settings& given, const Settings& resolved);

}  // namespace place
