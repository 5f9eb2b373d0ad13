#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <place/match/crossed_bearings.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::Bearing;

Bearing towards(double x_m, double y_m, double from_x_m, double from_y_m, double off_rad = 0) {
  return {from_x_m, from_y_m, std::atan2(x_m - from_x_m, y_m - from_y_m) + off_rad};
}

TEST(CrossedBearings, CrossAtTheirPlace) {
  // From (0, 0) at 45 degrees to the right, from (1, 0) straight ahead: they cross at (1, 1).
  const std::vector<Bearing> two{{0, 0, std::numbers::pi / 4}, {1, 0, 0}};
  const auto place = place::cross_bearings(two);
  ASSERT_TRUE(place);
  // What is believed beforehand, 3 m along y, draws by a hundredth of a line's 0.1 m.
  EXPECT_NEAR(place->x_m, 1, 0.01);
  EXPECT_NEAR(place->y_m, 1, 0.01);
  EXPECT_GT(place->y_sd_m, place->x_sd_m);  // the line along y says x
}

TEST(CrossedBearings, AreOffByWhatTheySay) {
  vo::Rng rng(1);
  double squared = 0, expected = 0;
  constexpr int kRuns = 200;
  for (int run = 0; run < kRuns; ++run) {
    const double x = rng.uniform(-1.5, 1.5), y = rng.uniform(-0.5, 0.5);
    std::vector<Bearing> bearings;
    for (int k = -3; k <= 3; ++k) bearings.push_back(towards(x, y, 0, 0.85 * k, 0.05 * rng.normal()));
    const auto place = place::cross_bearings(bearings);
    ASSERT_TRUE(place) << run;
    squared += (place->x_m - x) * (place->x_m - x);
    expected += place->x_sd_m * place->x_sd_m;
  }
  // Bearings here are as exact as is assumed, known places are exact.
  EXPECT_LT(squared, 1.2 * expected);
  EXPECT_GT(squared, 0.2 * expected);
}

TEST(CrossedBearings, LetAWrongOneGo) {
  std::vector<Bearing> bearings;
  for (int k = -3; k <= 3; ++k) bearings.push_back(towards(0.5, 0.2, 0, 0.85 * k));
  bearings[1].bearing_rad += 1.5;
  const auto place = place::cross_bearings(bearings);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x_m, 0.5, 0.05);  // Cauchy's weights leave it a little
  EXPECT_NEAR(place->y_m, 0.2, 0.1);
}

TEST(CrossedBearings, AlongOneLineSayThatTheyDoNotCross) {
  std::vector<Bearing> bearings;
  for (int k = 1; k <= 4; ++k) bearings.push_back({0, -1.0 * k, 0});
  const auto place = place::cross_bearings(bearings);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x_m, 0, 1e-6);
  EXPECT_LT(place->x_sd_m, 0.2);
  EXPECT_NEAR(place->y_sd_m, 3, 1e-6);  // as beforehand
}

TEST(CrossedBearings, AreNoneOfFewOrOfContradictions) {
  EXPECT_FALSE(place::cross_bearings({}));
  EXPECT_FALSE(place::cross_bearings(std::vector<Bearing>{{0, 0, 0.3}}));
  vo::Rng rng(2);
  int answers = 0;
  for (int run = 0; run < 100; ++run) {
    std::vector<Bearing> bearings;
    for (int k = -3; k <= 3; ++k) bearings.push_back({0, 0.85 * k, rng.uniform(-3.1, 3.1)});
    answers += place::cross_bearings(bearings) ? 1 : 0;
  }
  EXPECT_LT(answers, 50);  // most of random lines pass a common place seldom
}

}  // namespace
