#include "simulate/route.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace simulate {
namespace {

TEST(Route, IsLongEnoughAndNeverTurnsBack) {
  for (const Scene scene : {Scene::kStreet, Scene::kCorridor}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const Route route = make_route(scene, seed, 150);
      EXPECT_GE(route.path.length_m(), 150);
      for (double s = 0; s < 150; s += 0.5) {
        EXPECT_LE(std::abs(route.path.at(s).heading_rad), 66 * std::numbers::pi / 180);
      }
    }
  }
}

TEST(Route, IsThePrefixOfALongerOne) {
  const Route shorter = make_route(Scene::kStreet, 7, 50), longer = make_route(Scene::kStreet, 7, 400);
  ASSERT_LT(shorter.corners.size(), longer.corners.size());
  for (std::size_t i = 0; i < shorter.corners.size(); ++i) EXPECT_EQ(shorter.corners[i], longer.corners[i]);
  EXPECT_EQ(shorter.near_side, longer.near_side);
}

TEST(Route, DiffersBySeed) {
  EXPECT_NE(make_route(Scene::kStreet, 1, 50).corners[1], make_route(Scene::kStreet, 2, 50).corners[1]);
}

TEST(WalkPath, WithoutDetourIsTheRoute) {
  const Route route = make_route(Scene::kStreet, 3, 100);
  const WalkPath path(route, 30, 100, 0);
  EXPECT_DOUBLE_EQ(path.walked_m(), 70);
  EXPECT_DOUBLE_EQ(path.route_distance_m(12), 42);
  EXPECT_DOUBLE_EQ(path.at(12).x_m, route.path.at(42).x_m);
}

TEST(WalkPath, DetoursOffTheRouteAndBack) {
  for (const Scene scene : {Scene::kStreet, Scene::kCorridor}) {
    const Route route = make_route(scene, 3, 100);
    const WalkPath path(route, 0, 100, 20);
    // Twice ten metres; the arcs of half a metre at the four corners take off some, the way across adds some.
    EXPECT_NEAR(path.walked_m(), 120, 2);
    double before = -1, furthest = 0;
    vo::Pose2 last = path.at(0);
    for (double s = 0; s <= path.walked_m(); s += 0.05) {
      const vo::Pose2 pose = path.at(s);
      EXPECT_LE(std::hypot(pose.x_m - last.x_m, pose.y_m - last.y_m), 0.0501);  // nobody jumps
      last = pose;
      const double distance = path.route_distance_m(s);
      EXPECT_GT(distance, before);
      before = distance;
      const vo::Pose2 there = route.path.at(distance);
      furthest = std::max(furthest, std::hypot(pose.x_m - there.x_m, pose.y_m - there.y_m));
    }
    EXPECT_NEAR(furthest, 10, 0.6);  // up to half a metre beside the line at the far end
    EXPECT_NEAR(path.route_distance_m(path.walked_m()), 100, 1e-9);
  }
}

TEST(WalkPath, RefusesWhatItCannotWalk) {
  const Route route = make_route(Scene::kStreet, 3, 100);
  EXPECT_THROW(WalkPath(route, 50, 50, 0), std::invalid_argument);
  EXPECT_THROW(WalkPath(route, 0, 1e6, 0), std::invalid_argument);
  EXPECT_THROW(WalkPath(route, 0, 5, 20), vo::Error);  // no side street so near the beginning
}

}  // namespace
}  // namespace simulate
