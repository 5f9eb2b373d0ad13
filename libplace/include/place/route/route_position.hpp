#pragma once

#include "place/route/route.hpp"

#include <span>
#include <vector>

#include <vo/base/pose2.hpp>

namespace place {

/// A place beside a route.
struct RoutePosition {
  double distance_m = 0;  ///< along the traverse: surveyed where it is, else the length of its path
  double right_m = 0;     ///< from its path, to the right; to the left if negative
};

/// Where poses of one walk, in order, lie beside a traverse.
///
/// The path joins the keyframes' positions. Each pose belongs to the nearest point of the path at which the
/// traverse went into the pose's half of the compass, so that a way back on the same street is another one;
/// and from one pose to the next, to a point no further along than the walk may have got, so that a path that
/// crosses itself is followed. Where that leaves nothing within 20 m, the whole path is searched again.
/// Throws `std::invalid_argument` unless two keyframes have poses of different places. O(poses * keyframes)
/// at worst, usually O(poses).
std::vector<RoutePosition> positions_on_route(const Traverse& traverse, std::span<const vo::Pose2> poses);

}  // namespace place
