#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>
#include <vo/image/image_stack.hpp>
#include <vo/image/thumbnail.hpp>

namespace {

using testing::Each;
using testing::ElementsAre;

TEST(Thumbnail, AveragesEqualAreas) {
  // Four 2x2 blocks; each becomes the pixel of its mean.
  const cv::Mat image = (cv::Mat_<uchar>(2, 4) << 0, 10, 100, 100, 20, 30, 100, 104);
  std::vector<std::uint8_t> thumbnail(2);
  vo::make_thumbnail(image, {.width = 2, .height = 1}, thumbnail);
  EXPECT_THAT(thumbnail, ElementsAre(15, 101));
}

TEST(Thumbnail, WeighsPixelsByTheAreaCovered) {
  // Cells of 1.5 x 1.5 pixels: (4 whole pixels' weights 1, .5, .5, .25 of the corner) / 2.25.
  const cv::Mat image = (cv::Mat_<uchar>(3, 3) << 0, 90, 180, 9, 90, 0, 45, 0, 90);
  std::vector<std::uint8_t> thumbnail(4);
  vo::make_thumbnail(image, {.width = 2, .height = 2}, thumbnail);
  EXPECT_THAT(thumbnail, ElementsAre(32, 110, 32, 50));
}

TEST(Thumbnail, IsOpenCvsAreaResize) {
  vo::Rng rng(5);
  for (const cv::Size size : {cv::Size(640, 360), cv::Size(161, 97), cv::Size(64, 32), cv::Size(848, 480)}) {
    cv::Mat image(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) image.at<uchar>(y, x) = static_cast<uchar>(rng.index(256));
    }
    cv::Mat expected;
    cv::resize(image, expected, {64, 32}, 0, 0, cv::INTER_AREA);
    std::vector<std::uint8_t> thumbnail(64 * 32);
    vo::make_thumbnail(image, {}, thumbnail);
    for (std::size_t k = 0; k < thumbnail.size(); ++k) {
      // Its sums are in single precision and half a grey level rounds to even: one level apart at most.
      ASSERT_NEAR(thumbnail[k], expected.data[k], 1) << size << " at " << k;
    }
  }
}

TEST(Thumbnail, IsExactForAnySize) {
  // White pictures reach the largest sums; the sizes are on both sides of those that take 16 and 32 bits.
  for (const cv::Size size : {cv::Size(64, 257), cv::Size(64, 259), cv::Size(65'537, 257),
                              cv::Size(1009, 601), cv::Size(65'539, 2)}) {
    std::vector<std::uint8_t> thumbnail(3 * 2);
    vo::make_thumbnail(cv::Mat(size, CV_8UC1, cv::Scalar(255)), {.width = 3, .height = 2}, thumbnail);
    EXPECT_THAT(thumbnail, testing::Each(255)) << size.width << "x" << size.height;
  }
  // An odd picture halved: the middle row counts for both, half each.
  cv::Mat rows(601, 4, CV_8UC1, cv::Scalar(10));
  rows.rowRange(0, 301).setTo(200);
  std::vector<std::uint8_t> thumbnail(2);
  vo::make_thumbnail(rows, {.width = 1, .height = 2}, thumbnail);
  EXPECT_EQ(thumbnail[0], 200);
  EXPECT_EQ(thumbnail[1], 10);  // and half a row of 300.5 that is 190 more: 10.3
}

TEST(Thumbnail, KeepsGreyAsItIsAndTakesColour) {
  std::vector<std::uint8_t> thumbnail(8);
  vo::make_thumbnail(cv::Mat(2, 4, CV_8UC1, cv::Scalar(77)), {.width = 4, .height = 2}, thumbnail);
  EXPECT_THAT(thumbnail, Each(77));
  // Green carries 0.587 of the grey (ITU-R BT.601).
  vo::make_thumbnail(cv::Mat(20, 40, CV_8UC3, cv::Scalar(0, 200, 0)), {.width = 4, .height = 2}, thumbnail);
  EXPECT_THAT(thumbnail, Each(117));
}

TEST(Thumbnail, RefusesWhatItCannotTake) {
  std::vector<std::uint8_t> thumbnail(8);
  EXPECT_THROW(vo::make_thumbnail(cv::Mat(), {.width = 4, .height = 2}, thumbnail), std::invalid_argument);
  EXPECT_THROW(vo::make_thumbnail(cv::Mat(4, 4, CV_16UC1), {.width = 4, .height = 2}, thumbnail),
               std::invalid_argument);
  EXPECT_THROW(vo::make_thumbnail(cv::Mat(4, 4, CV_8UC1), {.width = 4, .height = 4}, thumbnail),
               std::invalid_argument);
}

TEST(ImageStack, SelectsInTheOrderAsked) {
  vo::ImageStack stack{.width = 2, .height = 1, .pixels = {1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(stack.size(), 3U);
  const std::vector<std::size_t> chosen{2, 0};
  EXPECT_THAT(vo::select(stack, chosen).pixels, ElementsAre(5, 6, 1, 2));
  const std::vector<std::size_t> outside{3};
  EXPECT_THROW(vo::select(stack, outside), std::out_of_range);
  EXPECT_TRUE(vo::ImageStack{}.empty());
}

}  // namespace
