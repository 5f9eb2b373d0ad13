#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/geometry/view_turn.hpp>

namespace {

struct Azimuths {
  std::vector<float> from, to;
};

/// `right` points seen by a camera that turned, `wrong` ones at random, over the 64 degrees of a view.
Azimuths turned(double turn_rad, int right, int wrong, std::uint64_t seed) {
  constexpr double kHalf_rad = 0.56;
  vo::Rng rng(seed);
  Azimuths points;
  for (int i = 0; i < right + wrong; ++i) {
    const double from = rng.uniform(-kHalf_rad, kHalf_rad);
    const double to = i < right ? from - turn_rad + 0.01 * rng.normal() : rng.uniform(-kHalf_rad, kHalf_rad);
    points.from.push_back(static_cast<float>(from));
    points.to.push_back(static_cast<float>(to));
  }
  return points;
}

TEST(ViewTurn, IsPositiveToTheRight) {
  // Turned by 0.2 to the right, what was 0.1 to the right is 0.1 to the left.
  const std::vector<float> from{0.1F, 0.1F, 0.3F, 0.2F, 0.0F, -0.1F},
      to{-0.1F, -0.1F, 0.1F, 0.0F, -0.2F, -0.3F};
  const auto turn = vo::view_turn(from, to, {.min_over_chance = 0});
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->turn_rad, 0.2, 1e-6);  // floats
  EXPECT_EQ(turn->agreeing, 6U);
  EXPECT_FALSE(vo::view_turn(from, to, {.min_agreeing = 7, .min_over_chance = 0}));
}

TEST(ViewTurn, StandsTwoWrongPointsForEachRightOne) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double turn_rad = 0.03 * (static_cast<double>(seed) - 10);
    const Azimuths points = turned(turn_rad, 25, 50, seed);
    const auto turn = vo::view_turn(points.from, points.to);
    ASSERT_TRUE(turn) << seed;
    // The mean of 25 that are off by 0.01 is off by 0.002, and wrong ones that lie near move it as much.
    EXPECT_NEAR(turn->turn_rad, turn_rad, 0.01) << seed;
    EXPECT_GE(turn->agreeing, 23U) << seed;
  }
}

TEST(ViewTurn, IsHardlyEverThatOfPointsAtRandom) {
  int answers = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Azimuths points = turned(0, 0, 40, seed);
    answers += vo::view_turn(points.from, points.to) ? 1 : 0;
  }
  EXPECT_LE(answers, 20);  // 3.5 deviations at the best of some 25 turns
}

TEST(ViewTurn, IsNoneOfTooFewPoints) {
  EXPECT_FALSE(vo::view_turn({}, {}));
  const std::vector<float> one{0.1F}, five(5, 0.2F);
  EXPECT_FALSE(vo::view_turn(one, one));
  EXPECT_FALSE(vo::view_turn(five, five));
  const std::vector<float> many(50, 0.2F);  // one point seen fifty times shows no more than chance
  EXPECT_FALSE(vo::view_turn(many, many));
  EXPECT_THROW(vo::view_turn(one, {}), std::invalid_argument);
  EXPECT_THROW(vo::view_turn(one, one, {.spread_rad = 0}), std::invalid_argument);
}

}  // namespace
