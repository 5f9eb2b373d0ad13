#include "support/blob_scene.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/surf/smooth_pyramid.hpp>

namespace {

int value(const vo::SmoothLevel& level, int x, int y) {
  return level.values[static_cast<std::size_t>(y * level.stride + x)];
}

TEST(SmoothPyramid, WorkedExample) {
  // One pixel of 64: by (1 2 1)^2 the first level has 4, 2 and 1 times 64; the rim is repeated outside.
  cv::Mat1b grey(5, 7, uchar{0});
  grey(2, 3) = 64;
  const auto pyramid = vo::smooth_pyramid(grey, 1);
  ASSERT_EQ(pyramid.levels.size(), 1U);
  const auto& level = pyramid.levels[0];
  EXPECT_EQ(value(level, 3, 2), 256);
  EXPECT_EQ(value(level, 2, 2), 128);
  EXPECT_EQ(value(level, 3, 1), 128);
  EXPECT_EQ(value(level, 4, 3), 64);
  EXPECT_EQ(value(level, 1, 2), 0);
  cv::Mat1b corner(3, 3, uchar{0});
  corner(0, 0) = 64;
  EXPECT_EQ(value(vo::smooth_pyramid(corner, 1).levels[0], 0, 0), 9 * 64);  // (1 + 2)^2
}

TEST(SmoothPyramid, EveryLevelHasTheDeviationItStates) {
  // A Gaussian blob of variance v, smoothed by a filter of variance f, is one of variance v + f: its top
  // falls by v / (v + f). Binomials (1 2 1) and (1 4 6 4 1) have variances 1/2 and 1 of their level's pixels.
  const auto pyramid = vo::smooth_pyramid(test_support::gaussian_blob({161, 161}, 80, 80, 8, 100), 1.6F * 6);
  ASSERT_EQ(pyramid.levels.size(), 6U);  // 1.6 * 2^(5/2) = 9.05 < 9.6
  double variance = 0.5;
  for (std::size_t l = 0; l < 6; ++l) {
    const auto& level = pyramid.levels[l];
    EXPECT_EQ(level.step_px, 1 << (l / 2));
    if (l % 2 == 1) variance += level.step_px * level.step_px;
    // Rounding to bytes and to 1/16 is within 1 grey level.
    EXPECT_NEAR(value(level, 80 / level.step_px, 80 / level.step_px) / 16.0, 128 + 100 * 64 / (64 + variance),
                1)
        << l;
    const double deviation_px = std::sqrt(variance) / level.step_px;
    EXPECT_GE(deviation_px, l % 2 == 0 ? 0.58 : 1.15);  // as the header states
    EXPECT_LE(deviation_px, l % 2 == 0 ? 0.71 : 1.23);
  }
}

TEST(SmoothPyramid, GivesTheLevelForAScale) {
  const auto pyramid = vo::smooth_pyramid(test_support::noise_picture({64, 64}, 1), 10);
  EXPECT_EQ(&pyramid.level(1), &pyramid.levels[0]);
  EXPECT_EQ(&pyramid.level(2.2F), &pyramid.levels[0]);
  EXPECT_EQ(&pyramid.level(2.3F), &pyramid.levels[1]);
  EXPECT_EQ(&pyramid.level(3.3F), &pyramid.levels[2]);
  EXPECT_EQ(&pyramid.level(2.3F, 2), &pyramid.levels[3]);
  EXPECT_EQ(&pyramid.level(1000), &pyramid.levels.back());
}

TEST(SmoothPyramid, KeepsAConstantImageAndEndsAtTheLeast) {
  const auto pyramid = vo::smooth_pyramid(cv::Mat(9, 33, CV_8UC1, cv::Scalar(255)), 1000);
  EXPECT_EQ(pyramid.levels.back().height, 2);
  for (const auto& level : pyramid.levels) {
    for (int y = 0; y < level.height; ++y) {
      for (int x = 0; x < level.width; ++x) ASSERT_EQ(value(level, x, y), 16 * 255);
    }
  }
  EXPECT_EQ(vo::smooth_pyramid(cv::Mat(1, 1, CV_8UC1, cv::Scalar(3)), 1000).levels[0].values[0], 48);
}

TEST(SmoothPyramid, IsTheSameForAnyThreadCount) {
  const cv::Mat grey = test_support::noise_picture({70, 300}, 2);
  vo::set_thread_count(1);
  const auto one = vo::smooth_pyramid(grey, 5);
  vo::set_thread_count(4);
  const auto four = vo::smooth_pyramid(grey, 5);
  vo::set_thread_count(0);
  ASSERT_EQ(one.levels.size(), four.levels.size());
  for (std::size_t l = 0; l < one.levels.size(); ++l) EXPECT_EQ(one.levels[l].values, four.levels[l].values);
}

TEST(SmoothPyramid, RefusesWhatIsNoGreyImage) {
  EXPECT_THROW(vo::smooth_pyramid(cv::Mat(), 5), std::invalid_argument);
  EXPECT_THROW(vo::smooth_pyramid(cv::Mat(4, 4, CV_8UC3), 5), std::invalid_argument);
  EXPECT_THROW(vo::smooth_pyramid(cv::Mat(4, 4, CV_32FC1), 5), std::invalid_argument);
}

}  // namespace
