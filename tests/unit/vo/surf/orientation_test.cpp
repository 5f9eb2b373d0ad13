#include "support/blob_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <vo/surf/orientation.hpp>
#include <vo/surf/surf.hpp>
#include <vo/tracks/matching.hpp>

namespace {

using std::numbers::pi;

double degrees(double rad) {
  return rad * 180 / pi;
}

/// A wave whose grey levels rise along `angle_rad`, steepest in the middle of 200 x 200 pixels.
cv::Mat wave(double angle_rad, double length_px) {
  cv::Mat1b grey(200, 200);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double along = (x - 100) * std::cos(angle_rad) + (y - 100) * std::sin(angle_rad);
      grey(y, x) = cv::saturate_cast<uchar>(128 + 100 * std::sin(2 * pi * along / length_px));
    }
  }
  return grey;
}

TEST(Orientation, IsWhereTheGreyLevelsRise) {
  // Within 7 scales of the middle the wave only rises.
  for (const float scale : {1.6F, 2.0F, 3.0F, 5.0F, 10.0F}) {
    for (double angle = -3.1; angle < 3.15; angle += 0.39) {
      const auto pyramid = vo::smooth_pyramid(wave(angle, 30 * scale), 4 * scale);
      const vo::Feature point{.x_px = 100, .y_px = 100, .scale_px = scale};
      // Rounding puts grey levels off by 0.3, and by 0.1 after smoothing, where they rise by 13 a pixel or,
      // at larger scales, less but over more pixels: 0.4 degrees of each of some 50 samples that count, 0.06
      // in all. Three times that.
      EXPECT_NEAR(degrees(std::remainder(vo::orientation(pyramid, point) - angle, 2 * pi)), 0, 0.18)
          << scale << ' ' << angle;
    }
  }
}

TEST(Orientation, IsTheStrongerOfTwoDirections) {
  // Two half planes with edges at right angles, one of twice the contrast.
  cv::Mat1b grey(100, 100, uchar{0});
  grey(cv::Rect(55, 0, 45, 100)) = 200;
  grey(cv::Rect(0, 60, 55, 40)) = 60;
  const auto pyramid = vo::smooth_pyramid(grey, 8);
  const float towards_right = vo::orientation(pyramid, {.x_px = 50, .y_px = 50, .scale_px = 2});
  // The lower half plane turns the end of the strong edge a little upwards, and no further than that.
  EXPECT_NEAR(degrees(towards_right), 0, 15);
  const float towards_bottom = vo::orientation(pyramid, {.x_px = 40, .y_px = 55, .scale_px = 2});
  EXPECT_NEAR(degrees(towards_bottom), 90, 15);
}

TEST(Orientation, DoesNotDependOnContrastOrBrightness) {
  const test_support::BlobScene scene(40, 40, 40, 1);
  const cv::Mat grey = scene.draw({100, 100});
  cv::Mat darker;
  grey.convertTo(darker, CV_8U, 0.5, 10);
  const vo::Feature point{.x_px = 50, .y_px = 50, .scale_px = 3};
  const float a = vo::orientation(vo::smooth_pyramid(grey, 12), point);
  const float b = vo::orientation(vo::smooth_pyramid(darker, 12), point);
  EXPECT_NEAR(degrees(std::remainder(a - b, 2 * pi)), 0, 0.5);  // rounding to half as many grey levels
}

TEST(Orientation, OfAConstantImageIsZero) {
  const auto pyramid = vo::smooth_pyramid(cv::Mat(50, 50, CV_8UC1, cv::Scalar(77)), 8);
  EXPECT_EQ(vo::orientation(pyramid, {.x_px = 25, .y_px = 25, .scale_px = 2}), 0);
  const auto least = vo::smooth_pyramid(cv::Mat(1, 1, CV_8UC1, cv::Scalar(77)), 8);
  EXPECT_EQ(vo::orientation(least, {.scale_px = 2}), 0);
}

class MedianOrientation : public testing::TestWithParam<double> {};

/// What the step detection lives on: the median over the matches of two pictures turns as the picture does.
TEST_P(MedianOrientation, TurnsWithTheImage) {
  const double scale = GetParam();
  const cv::Size size(600, 600);
  const test_support::BlobScene scene(static_cast<int>(1200 / scale / scale), 300 / scale, 300 / scale, 2);
  const vo::SurfOptions options{.detector = {.threshold = 5, .max_points = 0}};
  const auto before = vo::detect_surf(scene.draw(size, 0, scale), options);
  for (double angle_deg = -20; angle_deg <= 20; angle_deg += 5) {
    const auto after = vo::detect_surf(scene.draw(size, angle_deg * pi / 180, scale), options);
    std::vector<double> turns_deg;
    for (const auto& match : vo::match_features(before, after)) {
      turns_deg.push_back(degrees(std::remainder(
          after.points[match.to].orientation_rad - before.points[match.from].orientation_rad, 2 * pi)));
    }
    ASSERT_GE(turns_deg.size(), 100U) << angle_deg;
    const auto middle = turns_deg.begin() + static_cast<std::ptrdiff_t>(turns_deg.size() / 2);
    std::ranges::nth_element(turns_deg, middle);
    EXPECT_NEAR(*middle, angle_deg, 0.1) << turns_deg.size() << " matches";  // what is asked of the detector
  }
}

INSTANTIATE_TEST_SUITE_P(AtScales, MedianOrientation, testing::Values(0.7, 1.0, 1.5, 2.2));

}  // namespace
