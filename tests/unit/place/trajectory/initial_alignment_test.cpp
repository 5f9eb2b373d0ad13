#include "trajectory/initial_alignment.hpp"

#include "support/drifting_walk.hpp"
#include "trajectory/constraints.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace test_support;
using place::initial_alignment;
using place::PoseFix;
using place::pose_graph::State;

std::vector<State> align(const vo::Trajectory& odometry, const std::vector<PoseFix>& fixes) {
  return initial_alignment(odometry, place::travelled_by_node_m(odometry), fixes);
}

TEST(InitialAlignment, GoesThroughTheAnchorsAndTurnsEvenlyBetweenThem) {
  // Ten metres north; the map has the first three nodes as they are, and the last three moved and turned
  // right.
  vo::Trajectory odometry;
  for (int i = 0; i <= 10; ++i) odometry.push_back({static_cast<double>(i), {0, static_cast<double>(i), 0}});
  constexpr double kRight = std::numbers::pi / 2;
  const std::vector<PoseFix> fixes{{0, {0, 0, 0}, 3},      {1, {0, 1, 0}, 3},      {2, {0, 2, 0}, 3},
                                   {8, {5, 5, kRight}, 3}, {9, {6, 5, kRight}, 3}, {10, {7, 5, kRight}, 3}};
  const std::vector<State> states = align(odometry, fixes);
  ASSERT_EQ(states.size(), 11U);
  EXPECT_NEAR(states[0].value[State::kY], 0, 1e-9);
  EXPECT_NEAR(states[8].value[State::kX], 5, 1e-9);
  EXPECT_NEAR(states[8].value[State::kY], 5, 1e-9);
  EXPECT_NEAR(states[4].value[State::kHeading], kRight / 2, 1e-9);  // half-way between nodes 0 and 8
  EXPECT_NEAR(states[10].value[State::kHeading], kRight, 1e-9);
}

TEST(InitialAlignment, FollowsAHeadingThatGoesAstrayPastWrongMatches) {
  const vo::Trajectory truth = walk_round_corners(300, 7);
  const vo::Trajectory odometry =
      drifted(truth, {.step_scale = 1.08, .bias_rad_per_m = std::numbers::pi / 150});
  std::vector<PoseFix> fixes = fixes_of(truth, 2, 0.3, 0.2);
  replace_at_random(fixes, truth, 0.3, 1);
  const std::vector<State> states = align(odometry, fixes);
  ASSERT_EQ(states.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // Anchors three metres or so apart, each off by half a metre and a tenth of a radian.
    EXPECT_LT(std::hypot(states[i].value[State::kX] - truth[i].pose.x_m,
                         states[i].value[State::kY] - truth[i].pose.y_m),
              2);
    EXPECT_LT(std::abs(vo::wrap_angle_rad(states[i].value[State::kHeading] - truth[i].pose.heading_rad)), 0.4)
        << i;
  }
}

TEST(InitialAlignment, NoneWithoutAgreement) {
  const vo::Trajectory truth = walk_round_corners(20, 1);
  EXPECT_TRUE(align(truth, {}).empty());
  EXPECT_TRUE(align({}, {}).empty());
  EXPECT_TRUE(align(truth, {{3, truth[3].pose, 3}, {4, truth[4].pose, 3}}).empty());
  EXPECT_EQ(align(truth, {{3, truth[3].pose, 3}, {4, truth[4].pose, 3}, {5, truth[5].pose, 3}}).size(), 20U);
}

}  // namespace
