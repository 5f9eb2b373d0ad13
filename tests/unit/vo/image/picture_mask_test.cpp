#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/image/picture_mask.hpp>

namespace {

cv::Mat mask_of(cv::Size size, const cv::Rect& masked) {
  cv::Mat keep(size, CV_8UC1, cv::Scalar(255));
  keep(masked).setTo(0);
  return keep;
}

TEST(PictureMask, FillsFromAroundAndTouchesNothingElse) {
  cv::Mat picture(40, 60, CV_8UC1);
  for (int x = 0; x < 60; ++x) picture.col(x).setTo(cv::Scalar(2 * x + 40));
  const cv::Mat whole = picture.clone();
  const cv::Rect clock(20, 10, 16, 12);
  picture(clock).setTo(255);
  const vo::PictureMask mask(mask_of(picture.size(), clock));
  mask.fill(picture);
  cv::Mat outside = mask_of(picture.size(), clock);
  cv::Mat difference;
  cv::absdiff(picture, whole, difference);
  EXPECT_EQ(cv::countNonZero(difference & outside), 0);
  // Within, the slope goes on, at the pyramid's coarseness: 12 pixels of 2 grey levels from rim to middle.
  EXPECT_LE(cv::norm(picture(clock), whole(clock), cv::NORM_INF), 24);
  // No edge stands at the rim: neighbours differ by no more than the scene's slope and a few levels.
  for (int y = clock.y; y < clock.y + clock.height; ++y)
    EXPECT_NEAR(picture.at<std::uint8_t>(y, clock.x), picture.at<std::uint8_t>(y, clock.x - 1), 10) << y;
}

TEST(PictureMask, WhatIsMaskedDoesNotMatter) {
  const cv::Rect bonnet(0, 30, 60, 10);
  const vo::PictureMask mask(mask_of({60, 40}, bonnet));
  cv::Mat a(40, 60, CV_8UC3, cv::Scalar(10, 100, 200)), b = a.clone();
  a(bonnet).setTo(cv::Scalar(0, 0, 0));
  b(bonnet).setTo(cv::Scalar(255, 7, 99));
  mask.fill(a);
  mask.fill(b);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0);
  EXPECT_EQ(a.at<cv::Vec3b>(39, 30), cv::Vec3b(10, 100, 200));  // a plain scene is filled with itself
}

TEST(PictureMask, OnePixelThatIsKeptFillsAll) {
  cv::Mat keep(7, 5, CV_8UC1, cv::Scalar(0));
  keep.at<std::uint8_t>(6, 4) = 255;
  cv::Mat picture(7, 5, CV_8UC1, cv::Scalar(0));
  picture.at<std::uint8_t>(6, 4) = 77;
  vo::PictureMask(keep).fill(picture);
  EXPECT_EQ(cv::norm(picture, cv::Mat(7, 5, CV_8UC1, cv::Scalar(77)), cv::NORM_INF), 0);
}

TEST(PictureMask, RefusesWhatDoesNotFit) {
  EXPECT_THROW(vo::PictureMask(cv::Mat(4, 4, CV_8UC1, cv::Scalar(0))), std::invalid_argument);
  EXPECT_THROW(vo::PictureMask(cv::Mat()), std::invalid_argument);
  const vo::PictureMask mask(cv::Mat(4, 4, CV_8UC1, cv::Scalar(255)));
  cv::Mat other(4, 5, CV_8UC1, cv::Scalar(0));
  EXPECT_THROW(mask.fill(other), std::invalid_argument);
}

}  // namespace
