#include "place/route/route_position.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace place {
namespace {

struct Leg {
  double x_m, y_m;     // its start
  double east, north;  // unit vector
  double length_m;
  double from_m, to_m;  // along the route
  double path_m;        // length of the path before it
};

std::vector<Leg> legs_of(const Traverse& traverse) {
  std::vector<Leg> legs;
  const Keyframe* before = nullptr;
  double path_m = 0;
  for (const Keyframe& keyframe : traverse.keyframes) {
    if (!keyframe.pose) continue;
    if (before != nullptr) {
      const double x = keyframe.pose->x_m - before->pose->x_m, y = keyframe.pose->y_m - before->pose->y_m;
      const double length_m = std::hypot(x, y);
      if (!(length_m > 0)) continue;
      legs.push_back({before->pose->x_m, before->pose->y_m, x / length_m, y / length_m, length_m,
                      before->distance_m.value_or(path_m), keyframe.distance_m.value_or(path_m + length_m),
                      path_m});
      path_m += length_m;
    }
    before = &keyframe;
  }
  if (legs.empty()) throw std::invalid_argument("positions_on_route: a traverse with a path expected");
  return legs;
}

struct Found {
  std::size_t leg;
  double off_m;  // from the path
  double along;  // share of the leg
};

/// The nearest point on legs [begin, end) within 90 degrees of the pose's heading; on all legs if none is.
std::optional<Found> nearest(const std::vector<Leg>& legs, std::size_t begin, std::size_t end,
                             const vo::Pose2& pose) {
  std::optional<Found> best;
  const double east = std::sin(pose.heading_rad), north = std::cos(pose.heading_rad);
  for (std::size_t i = begin; i < end; ++i) {
    const Leg& leg = legs[i];
    if (leg.east * east + leg.north * north < 0) continue;
    const double x = pose.x_m - leg.x_m, y = pose.y_m - leg.y_m;
    const double along_m = std::clamp(x * leg.east + y * leg.north, 0.0, leg.length_m);
    const double off_m = std::hypot(x - along_m * leg.east, y - along_m * leg.north);
    if (!best || off_m < best->off_m) best = Found{i, off_m, along_m / leg.length_m};
  }
  return best;
}

}  // namespace

std::vector<RoutePosition> positions_on_route(const Traverse& traverse, std::span<const vo::Pose2> poses) {
  constexpr double kLost_m = 20;   // from the path
  constexpr double kSlack_m = 10;  // a walk may move back or forward by this beyond its own displacement
  const std::vector<Leg> legs = legs_of(traverse);
  const auto leg_at = [&](double path_m) {
    const auto after = std::ranges::upper_bound(legs, path_m, {}, &Leg::path_m);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - legs.begin() - 1, 0));
  };
  std::vector<RoutePosition> positions;
  std::optional<double> before_m;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const vo::Pose2& pose = poses[i];
    std::optional<Found> found;
    if (before_m) {
      const double moved_m = std::hypot(pose.x_m - poses[i - 1].x_m, pose.y_m - poses[i - 1].y_m);
      found =
          nearest(legs, leg_at(*before_m - kSlack_m), leg_at(*before_m + 2 * moved_m + kSlack_m) + 1, pose);
    }
    if (!found || found->off_m > kLost_m) {
      const std::optional<Found> anywhere = nearest(legs, 0, legs.size(), pose);
      if (!found || (anywhere && anywhere->off_m < found->off_m)) found = anywhere;
    }
    if (!found) {  // the whole route goes in the other direction
      vo::Pose2 back = pose;
      back.heading_rad += std::numbers::pi;
      found = nearest(legs, 0, legs.size(), back);
    }
    const Leg& leg = legs[found->leg];
    const double right_m = (pose.x_m - leg.x_m) * leg.north - (pose.y_m - leg.y_m) * leg.east;
    before_m = leg.path_m + found->along * leg.length_m;
    positions.push_back(
        {std::lerp(leg.from_m, leg.to_m, found->along), std::copysign(found->off_m, right_m)});
  }
  return positions;
}

}  // namespace place
