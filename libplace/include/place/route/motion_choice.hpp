#pragma once

#include "place/settings.hpp"

#include <vo/odometry.hpp>

namespace place {

/// What a walk's keyframes are sampled by, and why.
struct MotionChoice {
  Settings settings;      ///< the resolved settings with `motion` steps or sad, and none without effect
  double gait_share = 0;  ///< share of the seconds in motion that are gait, 0 to 1
};

/// The share of a walk's seconds in which the walker moves that are walking or running; seconds of standing
/// do not count, those without an answer (too dark, a blank wall) count as motion. 0 if there are none. O(n).
double share_of_gait(const vo::PedestrianMotion& motion);

/// Chooses what `motion auto` is for a route's first walk: `steps` if at least half of its motion is gait,
/// `sad` otherwise, as when the frame rate is too low to see steps. The same rule lets hybrid motion use
/// steps (`walk_motion`); neither paper has one.
///
/// `resolved`: settings with motion auto. Settings that only the other motion uses are dropped.
/// `odometry`: how steps are read. Throws `vo::Error` naming the walk if it shows no gait and only
/// `spacing-m` is given; `std::invalid_argument` for another motion, or a walk that was read without tracked
/// points. Cost: that of `vo::pedestrian_motion`.
MotionChoice choose_motion(const Settings& resolved, const vo::Walk& walk,
                           const vo::PedestrianMotionOptions& odometry);

}  // namespace place
