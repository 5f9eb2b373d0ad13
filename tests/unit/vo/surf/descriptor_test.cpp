#include "support/blob_scene.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/surf/descriptor.hpp>

namespace {

using testing::Each;

std::vector<float> describe(const cv::Mat& grey, const vo::Feature& point, std::size_t size = 64) {
  std::vector<float> values(size);
  vo::describe(vo::smooth_pyramid(grey, 2 * point.scale_px), point, values);
  return values;
}

double distance(const std::vector<float>& a, const std::vector<float>& b) {
  double squared = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squared += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(squared);
}

TEST(Descriptor, WorkedExample) {
  // Grey levels that rise to the right by 2 a column: dx = |dx| in every subregion alike but for its weight,
  // and dy = 0.
  cv::Mat1b grey(100, 100);
  for (int x = 0; x < 100; ++x) grey.col(x) = static_cast<uchar>(2 * x);
  const auto values = describe(grey, {.x_px = 50, .y_px = 50, .scale_px = 2});
  for (std::size_t cell = 0; cell < 16; ++cell) {
    // 1 / sqrt(32) = 0.18 on average, and at the corners by e^-1 / e^-0.1 less than in the middle
    EXPECT_GT(values[4 * cell], 0.05F);
    EXPECT_FLOAT_EQ(values[4 * cell + 2], values[4 * cell]);
    EXPECT_NEAR(values[4 * cell + 1], 0, 1e-6);  // rounding
    EXPECT_NEAR(values[4 * cell + 3], 0, 1e-6);
    EXPECT_NEAR(values[4 * cell], values[4 * (15 - cell)], 1e-6);
  }
  // Seen by a point that is turned to the right, its up is left: all of it is in dy, and negative.
  const auto turned = describe(
      grey, {.x_px = 50, .y_px = 50, .scale_px = 2, .orientation_rad = std::numbers::pi_v<float> / 2});
  for (std::size_t cell = 0; cell < 16; ++cell) {
    EXPECT_NEAR(turned[4 * cell], 0, 1e-5);
    EXPECT_LT(turned[4 * cell + 1], -0.05F);
  }
}

TEST(Descriptor, ExtendedSplitsTheSumsBySigns) {
  const cv::Mat grey = test_support::BlobScene(60, 50, 50, 1).draw({100, 100});
  const vo::Feature point{.x_px = 51, .y_px = 48, .scale_px = 2.5F, .orientation_rad = 1};
  const auto plain = describe(grey, point), extended = describe(grey, point, 128);
  // Pairs of the extended sums add up to the plain ones, in the order dx, dy, |dx|, |dy|, before both are
  // made of unit length.
  std::vector<float> sums;
  for (std::size_t i = 0; i < 128; i += 2) sums.push_back(extended[i] + extended[i + 1]);
  double squared = 0;
  for (const float sum : sums) squared += sum * sum;
  for (float& sum : sums) sum /= static_cast<float>(std::sqrt(squared));
  EXPECT_LT(distance(sums, plain), 1e-5);  // rounding of 128 floats
  EXPECT_GT(*std::ranges::max_element(extended), 0.05F);
}

TEST(Descriptor, IsOfUnitLength) {
  const cv::Mat grey = test_support::noise_picture({80, 80}, 2);
  for (const std::size_t size : {64U, 128U}) {
    const auto values = describe(grey, {.x_px = 30, .y_px = 44, .scale_px = 2}, size);
    double squared = 0;
    for (const float value : values) squared += value * value;
    EXPECT_NEAR(squared, 1, 1e-5);  // rounding of 128 floats
  }
}

TEST(Descriptor, TurnsWithTheImage) {
  const test_support::BlobScene scene(60, 50, 50, 3);
  const vo::Feature point{.x_px = 60, .y_px = 60, .scale_px = 3};  // the middle, about which the scene turns
  const auto upright = describe(scene.draw({121, 121}), point);
  const auto other = describe(test_support::BlobScene(60, 50, 50, 4).draw({121, 121}), point);
  for (const double angle : {0.2, 0.785, 2.0, -1.3}) {
    vo::Feature turned = point;
    turned.orientation_rad = static_cast<float>(angle);
    // A tenth of what another scene is off by: sampling between pixels and rounding to bytes remain.
    EXPECT_LT(distance(describe(scene.draw({121, 121}, angle), turned), upright),
              0.1 * distance(upright, other))
        << angle;
  }
}

TEST(Descriptor, GrowsWithTheImage) {
  const test_support::BlobScene scene(60, 50, 50, 5);
  const vo::Feature point{.x_px = 120, .y_px = 120, .scale_px = 3};
  vo::Feature grown = point;
  grown.scale_px = 6;
  // Twice the scale is one octave on, where everything is alike but for the rounding to bytes and to the
  // pyramid's steps, which are the same share of a grey level.
  EXPECT_LT(distance(describe(scene.draw({241, 241}), point), describe(scene.draw({241, 241}, 0, 2), grown)),
            0.05);
}

TEST(Descriptor, OfAConstantImageIsZero) {
  EXPECT_THAT(describe(cv::Mat(60, 60, CV_8UC1, cv::Scalar(200)), {.x_px = 30, .y_px = 30, .scale_px = 2}),
              Each(0));
  EXPECT_THAT(describe(cv::Mat(1, 1, CV_8UC1, cv::Scalar(200)), {.scale_px = 2}, 128), Each(0));
}

TEST(Descriptor, RefusesOtherSizes) {
  EXPECT_THROW(describe(cv::Mat(9, 9, CV_8UC1, cv::Scalar(1)), {.scale_px = 2}, 65), std::invalid_argument);
  EXPECT_THROW(describe(cv::Mat(9, 9, CV_8UC1, cv::Scalar(1)), {.scale_px = 2}, 0), std::invalid_argument);
}

}  // namespace
