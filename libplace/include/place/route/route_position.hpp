#pragma once

#include "place/route/route.hpp"

#include <span>
#include <vector>

#include <vo/base/pose2.hpp>

namespace place {

/// A place next to a route.
struct RoutePosition {
  double distance_m = 0;  ///< along the traverse: surveyed if available, else the length of its path
  double right_m = 0;     ///< from its path, to the right; to the left if negative
};

/// The positions of one walk's poses, in order, relative to a traverse.
///
/// The path joins the keyframes' positions. Each pose belongs to the nearest point of the path at which the
/// traverse went in the same direction to within 90 degrees, so that the return along the same street is
/// separate. From one pose to the next, the point moves no further along than the walk can have moved, so
/// that a path that crosses itself is followed. If that leaves nothing within 20 m, the whole path is
/// searched again. Throws `std::invalid_argument` unless two keyframes have poses at different places. At
/// worst O(poses * keyframes), usually O(poses).
std::vector<RoutePosition> positions_on_route(const Traverse& traverse, std::span<const vo::Pose2> poses);

}  // namespace place
