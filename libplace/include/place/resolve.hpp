#pragma once

#include "place/settings.hpp"

namespace place {

/// What settings are resolved for: which groups count, and whether steps are followed.
enum class Purpose {
  kRoute,     ///< a walk becomes a traverse: reading, motion, odometry
  kLocalise,  ///< a walk is found on a route: all groups
  kOdometry,  ///< steps and trajectory of a walk: reading, motion, odometry
};

/// Where settings are resolved.
struct ResolveContext {
  Purpose purpose = Purpose::kLocalise;
  const Settings* route = nullptr;  ///< of the route that the walk is on; null for a new route or none
  bool route_has_poses = false;     ///< a query's steps are followed then, to correct their drift
  bool pass_over = false;           ///< what has no effect is left out, not refused: a sweep's cells differ
};

/// Every setting that has an effect with its value, and no other: what was given, else what the route has,
/// else the default. To resolve the result again changes nothing, so a saved result repeats the run.
///
/// - Values are in range (`check_ranges`).
/// - `OfRoute::kFixed` settings are the route's; another value is refused. Of `sampling-n` and `spacing-m`
///   the route's are taken only if neither was given: each stands for a density of keyframes.
/// - A query keeps the route's motion, or has none; another motion has another unit and is refused.
/// - A setting that was given and has no effect is refused (`has_effect`). Those of groups that the purpose
///   does not have are passed over, so that one file of settings serves all commands; those of odometry have
///   an effect where steps are followed.
/// - `spacing-m` is 0.85 unless `sampling-n` was given; `sampling-n` is 6 where the motion may turn out not
///   to be metric, unless `spacing-m` alone was given.
/// - `accept-score` is 0.1 with `compat`; else it has no value unless given, and `accept-probability` counts.
/// - `v-min` and `v-max` come together, v-min <= v-max; `motion file` needs `motion-file`; `max-shift-px` is
///   less than half of the thumbnail's width.
///
/// Throws `vo::Error` naming the setting, what is wrong, and what was expected.
Settings resolve(const Settings& given, const ResolveContext& context);

/// True if resolved settings have steps followed.
bool follows_steps(const Settings& settings, const ResolveContext& context);

/// What a route keeps of resolved settings for the walks to come: those that are not each walk's own.
Settings kept_by_route(const Settings& given, const Settings& resolved);

}  // namespace place
