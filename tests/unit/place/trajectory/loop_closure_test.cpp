#include "support/drifting_walk.hpp"
#include "support/synthetic_walk.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/trajectory/loop_closure.hpp>

namespace {

using namespace test_support;
using place::find_loops;
using place::LoopClosure;

constexpr double kSpacing_m = 0.5, kSpacing_px = 12;

/// Keyframes half a metre apart past a wall, at each the place given.
vo::ImageStack views(const std::vector<std::size_t>& places) {
  const Wall wall(6000, 3);
  std::vector<double> place_px;
  for (const std::size_t place : places) place_px.push_back(kSpacing_px * static_cast<double>(place));
  return wall.walk(place_px).thumbnails;
}

std::vector<double> way(std::size_t keyframes) {
  std::vector<double> travelled_m;
  for (std::size_t i = 0; i < keyframes; ++i) travelled_m.push_back(kSpacing_m * static_cast<double>(i));
  return travelled_m;
}

TEST(LoopClosure, FindsTheSecondRound) {
  std::vector<std::size_t> places;  // 100 on, the first 60 again, and on to somewhere else
  for (std::size_t i = 0; i < 100; ++i) places.push_back(i);
  for (std::size_t i = 0; i < 60; ++i) places.push_back(i);
  for (std::size_t i = 0; i < 60; ++i) places.push_back(200 + i);
  const std::vector<LoopClosure> loops = find_loops(views(places), way(places.size()));
  std::size_t in_round = 0;
  for (const LoopClosure& loop : loops) {
    EXPECT_GE(loop.score, 1);
    // Sequences reach half their length beyond where the round begins and ends.
    ASSERT_TRUE(loop.node >= 95 && loop.node < 165) << loop.node;
    EXPECT_NEAR(static_cast<double>(loop.earlier), static_cast<double>(loop.node) - 100, 2);
    ++in_round;
  }
  EXPECT_GE(in_round, 50U);
}

TEST(LoopClosure, TheRecentPastIsNoLoop) {
  // Standing for 40 keyframes: all alike, but no way between them.
  std::vector<std::size_t> places;
  std::vector<double> travelled_m;
  for (std::size_t i = 0; i < 160; ++i) {
    places.push_back(i < 60 ? i : i < 100 ? 60 : i - 39);
    travelled_m.push_back(kSpacing_m * static_cast<double>(places.back()));
  }
  EXPECT_TRUE(find_loops(views(places), travelled_m).empty());
  // The same round as above is no loop if so much of the way is recent.
  std::vector<std::size_t> round;
  for (std::size_t i = 0; i < 160; ++i) round.push_back(i % 80);
  EXPECT_FALSE(find_loops(views(round), way(160)).empty());
  EXPECT_TRUE(find_loops(views(round), way(160), {.recent_m = 41}).empty());
}

TEST(LoopClosure, TiesTwoRoundsTogether) {
  // Two rounds of a square of 20 m, its wall seen again in the second; odometry that turns too far.
  vo::Trajectory truth{{0, {}}};
  std::vector<std::size_t> places{0};
  while (truth.size() < 320) {
    truth.push_back({truth.back().time_s + 1, advance(truth.back().pose, kSpacing_m,
                                                      truth.size() % 40 == 0 ? std::numbers::pi / 2 : 0)});
    places.push_back((truth.size() - 1) % 160);
  }
  const vo::Trajectory odometry = drifted(truth, {.turn_scale = 1.04});
  const std::vector<LoopClosure> loops = find_loops(views(places), way(places.size()));
  ASSERT_GE(loops.size(), 100U);
  const place::CorrectedWalk walk = place::correct_drift(odometry, {}, loops);
  EXPECT_GT(distance_m(odometry[319].pose, odometry[159].pose), 3);
  EXPECT_LT(distance_m(walk.poses[319].pose, walk.poses[159].pose), 0.5);
  EXPECT_LT(rmse_m(walk.poses, truth), 0.5 * rmse_m(odometry, truth));
}

TEST(LoopClosure, NothingShortAndConstant) {
  EXPECT_TRUE(find_loops(vo::make_image_stack(64, 32, 0), {}).empty());
  EXPECT_TRUE(find_loops(views({1, 2, 3}), way(3)).empty());
  EXPECT_TRUE(find_loops(vo::make_image_stack(64, 32, 120), way(120)).empty());
  EXPECT_THROW(find_loops(views({1, 2, 3}), way(2)), std::invalid_argument);
}

TEST(FindLoops, RefusesSettingsThatAreWrong) {
  for (const int length : {0, -1})
    EXPECT_THROW(find_loops(views({1, 2, 3}), way(3), {.search = {.length = length}}), std::invalid_argument);
}

}  // namespace
