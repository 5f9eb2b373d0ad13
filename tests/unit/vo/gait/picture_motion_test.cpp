#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/picture_motion.hpp>

namespace {

constexpr int kWidth = 641, kHeight = 361;  // middle at (320, 180)

vo::TrackedPoint moved(double x_px, double y_px, double right_px, double down_px) {
  vo::TrackedPoint point;
  point.from.x_px = static_cast<float>(x_px);
  point.from.y_px = static_cast<float>(y_px);
  point.to.x_px = static_cast<float>(x_px + right_px);
  point.to.y_px = static_cast<float>(y_px + down_px);
  return point;
}

/// Points all over the picture, moved as `motion` says.
std::vector<vo::TrackedPoint> field(const vo::PictureMotion& motion, int count, std::uint64_t seed = 1) {
  vo::Rng rng(seed);
  std::vector<vo::TrackedPoint> points;
  for (int i = 0; i < count; ++i) {
    const double x = rng.uniform(-320, 320), y = rng.uniform(-180, 180);
    points.push_back(moved(320 + x, 180 + y, motion.right_px + motion.growth * x - motion.roll_rad * y,
                           motion.down_px + motion.growth * y + motion.roll_rad * x));
  }
  return points;
}

TEST(PictureMotion, WorkedExample) {
  // Right of the middle by 100 px and below it by 100 px: growth of 1 % takes each 1 px outwards, a roll of
  // 0.02 rad the first 2 px down and the second 2 px to the left.
  const std::vector<vo::TrackedPoint> points{moved(420, 180, 3 + 1, 4 + 2), moved(320, 280, 3 - 2, 4 + 1),
                                             moved(320, 180, 3, 4)};
  const auto motion = vo::picture_motion(points, kWidth, kHeight);
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->right_px, 3, 1e-4);  // positions are floats: 3e-5 px at 420
  EXPECT_NEAR(motion->down_px, 4, 1e-4);
  EXPECT_NEAR(motion->growth, 0.01, 1e-6);
  EXPECT_NEAR(motion->roll_rad, 0.02, 1e-6);
}

TEST(PictureMotion, IsThatOfMostPoints) {
  const vo::PictureMotion truth{-2, 3, 0.004, 0.003};
  auto points = field(truth, 200);
  // A passer-by: a quarter of the points go elsewhere, together.
  for (int i = 0; i < 60; ++i) points.push_back(moved(100 + i, 100 + 2 * i, 14, 1));
  const auto motion = vo::picture_motion(points, kWidth, kHeight);
  ASSERT_TRUE(motion);
  // Cauchy's weight at 14 px, a hundred times the distance of the others, is next to nothing.
  EXPECT_NEAR(motion->right_px, truth.right_px, 0.02);
  EXPECT_NEAR(motion->down_px, truth.down_px, 0.02);
  EXPECT_NEAR(motion->growth, truth.growth, 1e-4);
  EXPECT_NEAR(motion->roll_rad, truth.roll_rad, 1e-4);
}

TEST(PictureMotion, OfTooFewPointsIsNone) {
  const std::vector<vo::TrackedPoint> one{moved(10, 20, 1, 1)};
  EXPECT_FALSE(vo::picture_motion({}, kWidth, kHeight));
  EXPECT_FALSE(vo::picture_motion(one, kWidth, kHeight));
  EXPECT_FALSE(vo::picture_motion(std::vector<vo::TrackedPoint>(20, one[0]), kWidth, kHeight));
}

TEST(PictureMotion, OfAStillPictureIsZero) {
  const auto motion = vo::picture_motion(field({}, 20), kWidth, kHeight);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->right_px, 0);
  EXPECT_EQ(motion->down_px, 0);
  EXPECT_EQ(motion->growth, 0);
  EXPECT_EQ(motion->roll_rad, 0);
}

}  // namespace
