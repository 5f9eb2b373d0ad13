#include "street.hpp"

#include "facade.hpp"
#include "furniture.hpp"
#include "ground.hpp"
#include "sky.hpp"

#include <algorithm>
#include <cmath>

#include <vo/base/rng.hpp>

namespace simulate {
namespace {

constexpr double kFacadeTexels_per_m = 40;
constexpr double kSideTexels_per_m = 20;
constexpr double kHouseDepth_m = 8;
constexpr double kLampHeight_m = 4.5;
const cv::Vec3f kSodium(0.22F, 0.50F, 0.72F);  // warm: the colour cast of the night

// A house whose front runs from one point to the other, left to right as one looks at it.
void add_house(const Eigen::Vector2d& left, const Eigen::Vector2d& right, double height_m, std::uint64_t seed,
               WorldBuilder& builder) {
  const Eigen::Vector2d front = right - left;
  const Eigen::Vector2d back = Eigen::Vector2d(-front.y(), front.x()).normalized() * kHouseDepth_m;
  builder.add_wall(left, right, 0, height_m, kFacadeTexels_per_m,
                   facade_painter({front.norm(), height_m}, seed));
  const Painter side = side_wall_painter({kHouseDepth_m, height_m}, seed);
  builder.add_wall(left + back, left, 0, height_m, kSideTexels_per_m, side);
  builder.add_wall(right, right + back, 0, height_m, kSideTexels_per_m, side);
}

// Houses along one side of a leg, `offset_m` from its line, as far as the next corner's row.
void add_row(const Leg& leg, int side, double offset_m, const SideStreet* opening, vo::Rng rng,
             WorldBuilder& builder) {
  const double end = leg.length_m + leg.reach_after_m(side * offset_m);
  double at = leg.index == 0 ? -15 : -leg.reach_before_m(side * offset_m);
  bool opened = opening == nullptr;
  while (at < end - 2) {
    double width = rng.uniform(5, 13);
    const double height = rng.uniform(4.5, 14);
    const double setback = offset_m + rng.uniform(-0.3, 0.5);
    const std::uint64_t seed = rng.bits();
    const bool garden = rng.index(9) == 0;
    if (!opened) {
      const double gap_begin = opening->along_m - opening->width_m / 2;
      if (at + width > gap_begin - 3) width = gap_begin - at;
    }
    width = std::min(width, end - at);
    if (end - at - width < 3) width = end - at;
    if (garden && opened && width < 9) {
      add_garden(leg.pose(at + width / 2, side * (setback + 1)), width, seed, builder);
    } else if (side > 0) {
      add_house(leg.at(at + width, setback), leg.at(at, setback), height, seed, builder);
    } else {
      add_house(leg.at(at, -setback), leg.at(at + width, -setback), height, seed, builder);
    }
    at += width;
    if (!opened && at >= opening->along_m - opening->width_m / 2 - 1e-6) {
      at = opening->along_m + opening->width_m / 2;
      opened = true;
    }
  }
}

// The houses along both sides of a side street and the one at its end.
void add_side_street(const Leg& leg, const SideStreet& street, double offset_m, vo::Rng rng,
                     WorldBuilder& builder) {
  // Looking off the route to its right, what lies ahead along the route is on the left.
  const double l = street.along_m + street.side * street.width_m / 2;
  const double r = street.along_m - street.side * street.width_m / 2;
  const auto at = [&](double along, double depth) { return leg.at(along, street.side * (offset_m + depth)); };
  const auto wall = [&](double along, bool on_left) {
    for (double depth = 0; depth < kSideStreetDepth_m;) {
      const double width = std::min(rng.uniform(6, 12), kSideStreetDepth_m - depth);
      const double height = rng.uniform(4.5, 9);
      const Eigen::Vector2d nearer = at(along, depth), further = at(along, depth + width);
      const std::uint64_t seed = rng.bits();
      builder.add_wall(on_left ? nearer : further, on_left ? further : nearer, 0, height,
                       kFacadeTexels_per_m / 2, facade_painter({width, height}, seed));
      depth += width;
    }
  };
  wall(l, true);
  wall(r, false);
  add_house(at(l, kSideStreetDepth_m), at(r, kSideStreetDepth_m), 7, rng.bits(), builder);
}

void add_furniture(const Leg& leg, int near_side, vo::Rng rng, WorldBuilder& builder) {
  const double s = near_side;
  for (double at = rng.uniform(2, 8); at < leg.length_m - 2; at += rng.uniform(16, 24)) {
    const cv::Vec3f bgr = kSodium * rng.uniform(0.75, 1.25);
    add_street_lamp(leg.pose(at, -1.75 * s), kLampHeight_m, bgr, rng.bits(), builder);
  }
  for (double at = rng.uniform(1, 10); at < leg.length_m - 1; at += rng.uniform(6, 18)) {
    const TreeSize size{rng.uniform(1.1, 1.9), rng.uniform(2.0, 2.6)};
    add_tree(leg.pose(at, -1.7 * s), size, rng.bits(), builder);
  }
  for (double at = rng.uniform(0, 12); at < leg.length_m; at += rng.uniform(7, 22)) {
    const TreeSize size{rng.uniform(1.3, 2.4), rng.uniform(2.0, 3.0)};
    add_tree(leg.pose(at, -10.4 * s), size, rng.bits(), builder);
  }
  for (double at = rng.uniform(0, 8); at < leg.length_m - 3; at += rng.uniform(5.2, 16)) {
    add_car(leg.pose(at, -3.3 * s), rng.bits(), builder);
  }
  for (double at = rng.uniform(0, 8); at < leg.length_m - 3; at += rng.uniform(5.2, 12)) {
    add_car(leg.pose(at, -7.9 * s), rng.bits(), builder);
  }
  for (double at = rng.uniform(2, 9); at < leg.length_m - 1; at += rng.uniform(5, 15)) {
    const double right_m = rng.index(2) == 0 ? -1.55 : 2.3;
    add_street_thing(leg.pose(at, right_m * s), rng.bits(), builder);
  }
}

}  // namespace

void build_street(const Route& route, std::uint64_t seed, Condition condition, WorldBuilder& builder) {
  constexpr double kNear_m = 3.0, kFar_m = 12.0;
  for (const SideStreet& street : route.side_streets) {
    const Leg leg = route.leg(street.leg);
    // Every leg has a stream of its own, so that a longer route begins with the shorter one.
    vo::Rng rng(seed * 0x9e3779b97f4a7c15U + street.leg);
    add_row(leg, route.near_side, kNear_m, &street, rng.split(), builder);
    add_row(leg, -route.near_side, kFar_m, nullptr, rng.split(), builder);
    add_side_street(leg, street, kNear_m, rng.split(), builder);
    add_furniture(leg, route.near_side, rng.split(), builder);
  }
  add_street_ground(route, seed, condition, builder);
  add_sky(seed, condition, builder);
}

}  // namespace simulate
