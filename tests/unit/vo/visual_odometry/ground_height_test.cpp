#include "support/rendered_room.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/visual_odometry/ground_height.hpp>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(HeightsAbove, TakesWhatIsBelowAheadAndNear) {
  const std::vector<cv::Vec3d> points{{0, 1.5, 5},    // ground
                                      {3, 1.5, 8.9},  // just within six heights
                                      {0, 1.5, 9.1},  // just beyond
                                      {0, -0.5, 4},   // above the camera
                                      {0, 1.5, -1}};  // behind it
  EXPECT_THAT(vo::heights_above({}, {0, 0, 1}, points), ElementsAre(1.5, 1.5));
}

TEST(HeightsAbove, IsMeasuredAcrossTheWayHoweverTheCameraNods) {
  // The way goes level along z; the camera looks 0.3 rad down from it, and its world is turned as a whole.
  const vo::Pose3 world{.rotation = test_support::turned(0.7, {}).rotation, .position = {4, 5, 6}};
  const vo::Pose3 nodding{
      .rotation = {1, 0, 0, 0, std::cos(0.3), std::sin(0.3), 0, -std::sin(0.3), std::cos(0.3)},
      .position = {0, 0, 0}};
  const std::vector<cv::Vec3d> ground{world.rotation * cv::Vec3d(1, 1.4, 4) + world.position,
                                      world.rotation * cv::Vec3d(-2, 1.4, 6) + world.position};
  const std::vector<double> heights =
      vo::heights_above(vo::compose(world, nodding), world.rotation * cv::Vec3d(0, 0, 2), ground);
  EXPECT_THAT(heights, testing::Pointwise(testing::DoubleNear(1e-12), {1.4, 1.4}));
}

TEST(HeightsAbove, SaysNothingWithoutAWay) {
  EXPECT_THAT(vo::heights_above({}, {0, 0, 0}, std::vector<cv::Vec3d>{{0, 1, 2}}), IsEmpty());
  EXPECT_THAT(vo::heights_above({}, {0, 1, 0}, std::vector<cv::Vec3d>{{0, 1, 2}}), IsEmpty());
  EXPECT_THAT(vo::heights_above({}, {0, 0, 1}, {}), IsEmpty());
}

TEST(GroundHeight, IsTheOneThatMostAgreeOn) {
  // Thirty points of ground at 1.6, with noise of 4 %, among ninety of hedges and cars at any height.
  vo::Rng rng(4);
  std::vector<double> heights;
  for (int i = 0; i < 30; ++i) heights.push_back(1.6 * std::exp(0.04 * rng.normal()));
  for (int i = 0; i < 90; ++i) heights.push_back(std::exp(rng.uniform(std::log(0.2), std::log(3.0))));
  const std::optional<double> height = vo::ground_height(heights);
  ASSERT_TRUE(height);
  // The mean of thirty is good to 4 % / sqrt(30); the others under the kernel add as much again.
  EXPECT_NEAR(*height, 1.6, 0.03 * 1.6);
}

TEST(GroundHeight, IsLookedForWhereItIsExpected) {
  // A hedge's top, of which more is seen than of the ground below it.
  std::vector<double> heights(30, 0.6);
  heights.insert(heights.end(), 10, 1.5);
  EXPECT_NEAR(vo::ground_height(heights).value(), 0.6, 1e-9);
  EXPECT_NEAR(vo::ground_height(heights, vo::ExpectedHeight{1.6, 0.3}).value(), 1.5, 1e-9);
  // The expectation chooses a peak, it does not move it; one too weak to choose by leaves the highest.
  EXPECT_NEAR(vo::ground_height(heights, vo::ExpectedHeight{1.6, 3}).value(), 0.6, 1e-9);
  EXPECT_FALSE(vo::ground_height(heights, vo::ExpectedHeight{1e9, 0.1}));
}

TEST(GroundHeight, GoesWithTheUnit) {
  const std::vector<double> heights{1.5, 1.52, 1.49, 1.5, 1.51, 1.48, 1.5, 1.5, 1.53, 1.5, 0.4, 0.9, 2.2};
  std::vector<double> in_another;
  for (const double height : heights) in_another.push_back(7 * height);
  EXPECT_NEAR(vo::ground_height(in_another).value(), 7 * vo::ground_height(heights).value(), 1e-9);
}

TEST(GroundHeight, IsNoneIfTooFewAgree) {
  EXPECT_FALSE(vo::ground_height({}));
  EXPECT_FALSE(vo::ground_height(std::vector<double>{1.5}));
  std::vector<double> at_all_heights;
  for (int i = 0; i < 40; ++i) at_all_heights.push_back(0.2 * std::pow(1.1, i));
  EXPECT_FALSE(vo::ground_height(at_all_heights));
  EXPECT_NEAR(vo::ground_height(std::vector<double>(8, 1.5)).value(), 1.5, 1e-12);
}

TEST(GroundHeight, RefusesSettingsOutOfRange) {
  EXPECT_THROW(vo::ground_height({}, {}, {.spread = 0}), std::invalid_argument);
  EXPECT_THROW(vo::ground_height({}, vo::ExpectedHeight{1, 0}), std::invalid_argument);
  EXPECT_THROW(vo::heights_above({}, {0, 0, 1}, {}, {.max_ahead = 0}), std::invalid_argument);
}

}  // namespace
