#include "support/drifting_walk.hpp"

#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include <place/route/route_position.hpp>

namespace {

using place::positions_on_route;
constexpr double kPi = std::numbers::pi;

place::Traverse traverse_of(const std::vector<vo::Pose2>& poses,
                            std::optional<double> distance_per_keyframe = {}) {
  place::Traverse traverse;
  for (const vo::Pose2& pose : poses) {
    place::Keyframe keyframe;
    keyframe.pose = pose;
    if (distance_per_keyframe)
      keyframe.distance_m = *distance_per_keyframe * static_cast<double>(traverse.keyframes.size());
    traverse.keyframes.push_back(keyframe);
  }
  return traverse;
}

TEST(RoutePosition, ByHand) {
  // 10 m north, then 10 m east.
  const std::vector<vo::Pose2> path{{0, 0, 0}, {0, 10, 0}, {10, 10, kPi / 2}};
  const std::vector<vo::Pose2> poses{
      {0.5, 4, 0}, {-1, 9, 0.3}, {5, 9.25, kPi / 2}, {5, 12, 1}, {14, 10, kPi / 2}};
  const auto positions = positions_on_route(traverse_of(path), poses);
  ASSERT_EQ(positions.size(), 5U);
  const double distance_m[] = {4, 9, 15, 15, 20}, right_m[] = {0.5, -1, 0.75, -2, 4};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(positions[i].distance_m, distance_m[i], 1e-12) << i;
    EXPECT_NEAR(std::abs(positions[i].right_m), std::abs(right_m[i]), 1e-12) << i;
    EXPECT_TRUE(i == 4 || std::signbit(positions[i].right_m) == std::signbit(right_m[i])) << i;
  }
  // Surveyed distances count before the path's length.
  EXPECT_NEAR(positions_on_route(traverse_of(path, 100), poses)[2].distance_m, 150, 1e-9);
}

TEST(RoutePosition, TellsTheWayBackFromTheWayThere) {
  const std::vector<vo::Pose2> path{{0, 0, 0}, {0, 30, 0}, {0.5, 30, kPi}, {0.5, 0, kPi}};
  const auto positions = positions_on_route(traverse_of(path), std::vector<vo::Pose2>{{0.4, 10, 0}});
  EXPECT_NEAR(positions[0].distance_m, 10, 1e-12);
  EXPECT_NEAR(positions_on_route(traverse_of(path), std::vector<vo::Pose2>{{0.1, 10, kPi}})[0].distance_m,
              50.5, 1e-12);
}

TEST(RoutePosition, FollowsAPathThatCrossesItself) {
  // North over (0, 20), round to the right, and back across it to the west.
  std::vector<vo::Pose2> path;
  for (int i = 0; i <= 40; ++i) path.push_back({0, static_cast<double>(i), 0});
  for (int i = 0; i <= 20; ++i)
    path.push_back(
        {10.0 * std::sin(i * kPi / 20) + 0.0, 30 + 10 * std::cos(i * kPi / 20), kPi / 2 + i * kPi / 20});
  for (int i = 1; i <= 20; ++i) path.push_back({-static_cast<double>(i), 20, -kPi / 2});
  const place::Traverse traverse = traverse_of(path);
  const auto positions = positions_on_route(traverse, path);
  for (std::size_t i = 1; i < path.size(); ++i) {
    EXPECT_NEAR(positions[i].right_m, 0, 1e-9);
    EXPECT_GE(positions[i].distance_m, positions[i - 1].distance_m - 1e-9) << i;
  }
}

TEST(RoutePosition, AWalkTheOtherWayStillHasAPlace) {
  const auto positions = positions_on_route(traverse_of({{0, 0, 0}, {0, 10, 0}}),
                                            std::vector<vo::Pose2>{{1, 4, kPi}, {1, 3, kPi}});
  EXPECT_NEAR(positions[1].distance_m, 3, 1e-12);
  EXPECT_NEAR(positions[1].right_m, 1, 1e-12);
}

TEST(RoutePosition, NoPathNoPosition) {
  EXPECT_THROW(positions_on_route({}, {}), std::invalid_argument);
  EXPECT_THROW(positions_on_route(traverse_of({{1, 1, 0}, {1, 1, 0}}), {}), std::invalid_argument);
  EXPECT_TRUE(positions_on_route(traverse_of({{0, 0, 0}, {0, 1, 0}}), {}).empty());
}

}  // namespace
