#include "support/blob_scene.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include <vo/surf/integral_image.hpp>

namespace {

TEST(IntegralImage, WorkedExample) {
  const cv::Mat grey = (cv::Mat_<uchar>(2, 3) << 1, 2, 3, 4, 5, 6);
  const auto integral = vo::integral_image(grey);
  EXPECT_EQ(integral.width, 3);
  EXPECT_EQ(integral.height, 2);
  EXPECT_EQ(integral.row(0)[3], 0U);
  EXPECT_EQ(integral.row(1)[2], 3U);
  EXPECT_EQ(integral.row(2)[0], 0U);
  EXPECT_EQ(integral.row(2)[3], 21U);
  EXPECT_EQ(integral.box(1, 0, 3, 2), 16U);
  EXPECT_EQ(integral.box(1, 1, 2, 2), 5U);
  EXPECT_EQ(integral.box(1, 1, 1, 2), 0U);
}

TEST(IntegralImage, BoxesAreTheSumsOfTheirPixels) {
  // A part of a larger picture, so that rows do not follow each other.
  const cv::Mat grey = test_support::noise_picture({50, 40}, 1)(cv::Rect(3, 5, 37, 29));
  const auto integral = vo::integral_image(grey);
  vo::Rng rng(2);
  for (int i = 0; i < 200; ++i) {
    const int x0 = static_cast<int>(rng.index(38)), x1 = x0 + static_cast<int>(rng.index(38 - x0));
    const int y0 = static_cast<int>(rng.index(30)), y1 = y0 + static_cast<int>(rng.index(30 - y0));
    const cv::Mat part = grey(cv::Range(y0, y1), cv::Range(x0, x1));
    EXPECT_EQ(integral.box(x0, y0, x1, y1), part.empty() ? 0 : cv::sum(part)[0]);
  }
}

TEST(IntegralImage, IsExactForTheLargestImage) {
  const auto integral = vo::integral_image(cv::Mat(4096, 4096, CV_8UC1, cv::Scalar(255)));
  EXPECT_EQ(integral.box(0, 0, 4096, 4096), 255U * 4096 * 4096);
  EXPECT_EQ(integral.box(4095, 4095, 4096, 4096), 255U);
}

TEST(IntegralImage, OfUnusableImages) {
  EXPECT_EQ(vo::integral_image(cv::Mat()).width, 0);
  EXPECT_THROW(vo::integral_image(cv::Mat(4, 4, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(vo::integral_image(cv::Mat(4, 4, CV_16UC1)), std::invalid_argument);
  EXPECT_THROW(vo::integral_image(cv::Mat(4096, 4097, CV_8UC1)), std::invalid_argument);
}

TEST(Coarser, IsTheIntegralImageOfTheShrunkImage) {
  const cv::Mat grey = test_support::noise_picture({23, 17}, 3);
  const auto coarse = vo::coarser(vo::integral_image(grey), 4);
  ASSERT_EQ(coarse.width, 5);
  ASSERT_EQ(coarse.height, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(coarse.box(x, y, x + 1, y + 1), cv::sum(grey(cv::Rect(4 * x, 4 * y, 4, 4)))[0]);
  }
}

TEST(Coarser, OfEmptyAndWrongInput) {
  const auto integral = vo::integral_image(test_support::noise_picture({3, 3}, 1));
  EXPECT_EQ(vo::coarser(integral, 4).width, 0);
  EXPECT_EQ(vo::coarser(vo::integral_image(cv::Mat()), 2).height, 0);
  EXPECT_THROW(vo::coarser(integral, 0), std::invalid_argument);
}

}  // namespace
