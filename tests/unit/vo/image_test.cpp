#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

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
