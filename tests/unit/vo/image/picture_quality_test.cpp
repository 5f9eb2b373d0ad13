#include "vo/image/picture_quality.hpp"

#include <cstdint>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/base/rng.hpp>

namespace {

using testing::Optional;

/// Blocks of random levels, each some pixels wide and high.
cv::Mat blocks(int side_px, cv::Size size = {320, 240}) {
  vo::Rng rng(3);
  cv::Mat small((size.height + side_px - 1) / side_px, (size.width + side_px - 1) / side_px, CV_8UC1);
  for (auto value = small.begin<std::uint8_t>(); value != small.end<std::uint8_t>(); ++value)
    *value = static_cast<std::uint8_t>(60 + rng.index(120));
  cv::Mat large;
  cv::resize(small, large, {}, side_px, side_px, cv::INTER_NEAREST);
  return large(cv::Rect({0, 0}, size)).clone();
}

double blur_of(const cv::Mat& picture) {
  return vo::picture_quality(picture).blur.value();
}

TEST(PictureQuality, AnEdgeAmongNineLosesEightNinths) {
  // One edge of 90: after a mean over nine it is nine steps of 10. The difference of 90 becomes 10 where it
  // is.
  cv::Mat edge(8, 100, CV_8UC1, cv::Scalar(50));
  edge.colRange(50, 100).setTo(140);
  EXPECT_NEAR(blur_of(edge), 1.0 / 9, 1e-6);      // single precision
  EXPECT_NEAR(blur_of(edge.t()), 1.0 / 9, 1e-6);  // as much along columns
  cv::Mat ramp(8, 100, CV_8UC1);
  for (int x = 0; x < 100; ++x) ramp.col(x).setTo(2 * x);
  EXPECT_GT(blur_of(ramp), 0.9);  // smoothing changes only its ends
}

TEST(PictureQuality, BlurRisesWithTheWidthOfTheFilterAndNotWithContrast) {
  const cv::Mat sharp = blocks(3);
  double before = blur_of(sharp);
  for (const double width_px : {0.5, 1.0, 2.0, 4.0}) {
    cv::Mat blurred;
    cv::GaussianBlur(sharp, blurred, {}, width_px);
    const double blur = blur_of(blurred);
    EXPECT_GT(blur, before) << width_px;
    before = blur;
  }
  cv::Mat faint;
  sharp.convertTo(faint, CV_8U, 0.5, 40);
  EXPECT_NEAR(blur_of(faint), blur_of(sharp), 0.02);  // rounding to whole levels
}

TEST(PictureQuality, LevelIsTheMean) {
  EXPECT_DOUBLE_EQ(vo::picture_quality(cv::Mat(10, 10, CV_8UC1, cv::Scalar(37))).level, 37);
  cv::Mat halves(10, 10, CV_8UC1, cv::Scalar(0));
  halves.colRange(5, 10).setTo(200);
  EXPECT_DOUBLE_EQ(vo::picture_quality(halves).level, 100);
}

TEST(PictureQuality, LargePicturesAreMeasuredAsSmallOnes) {
  const cv::Mat small = blocks(8, {640, 320});
  cv::Mat large;
  cv::resize(small, large, {}, 3, 3, cv::INTER_NEAREST);
  EXPECT_NEAR(blur_of(large), blur_of(small), 1e-6);
}

TEST(PictureQuality, ConstantTinyAndWrongPictures) {
  EXPECT_FALSE(vo::picture_quality(cv::Mat(10, 10, CV_8UC1, cv::Scalar(9))).blur);
  EXPECT_FALSE(vo::picture_quality(cv::Mat(1, 1, CV_8UC1, cv::Scalar(9))).blur);
  EXPECT_THROW(vo::picture_quality(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(vo::picture_quality(cv::Mat(4, 4, CV_8UC3)), std::invalid_argument);
}

}  // namespace
