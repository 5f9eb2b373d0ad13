#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vo/image/grey_range.hpp>

namespace {

TEST(GreyRange, IsWhatThePicturesUse) {
  // 0 to 999 twice, and one hot pixel: a thousandth of 2001 values at either end is two.
  cv::Mat first(1, 1000, CV_16UC1), second(1, 1001, CV_16UC1);
  for (int i = 0; i < 1000; ++i)
    first.at<std::uint16_t>(i) = second.at<std::uint16_t>(i) = static_cast<std::uint16_t>(i);
  second.at<std::uint16_t>(1000) = 60000;
  const std::vector<cv::Mat> pictures{first, second};
  const auto range = vo::range_of(pictures);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->black, 1);
  EXPECT_EQ(range->white, 999);
}

TEST(GreyRange, OfALargePictureIsFoundOnAMillionPixels) {
  cv::Mat ramp(3000, 3000, CV_16UC1);
  for (int x = 0; x < 3000; ++x) ramp.col(x).setTo(cv::Scalar(1000 + 2 * x));
  const cv::Mat thin = vo::thinned(ramp);
  EXPECT_LE(thin.total(), 1'010'000U);
  EXPECT_EQ(thin.type(), CV_16UC1);
  const auto range = vo::range_of(std::vector<cv::Mat>{thin});
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->black, 1000, 30);  // a thousandth of the pixels and a column that is left out
  EXPECT_NEAR(range->white, 6998, 30);
  const cv::Mat small(20, 30, CV_32FC3, cv::Scalar::all(1));
  EXPECT_EQ(vo::thinned(small).size(), small.size());
}

TEST(GreyRange, StretchesLinearly) {
  const cv::Mat picture = (cv::Mat_<std::uint16_t>(1, 5) << 0, 1000, 1600, 2000, 65535);
  const cv::Mat image = vo::stretched(picture, {.black = 1000, .white = 2000});
  ASSERT_EQ(image.type(), CV_8UC1);
  const std::vector<int> expected{0, 0, 153, 255, 255};
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(image.at<std::uint8_t>(i), expected[static_cast<std::size_t>(i)]) << i;
  EXPECT_EQ(vo::stretched(cv::Mat(2, 2, CV_32FC3, cv::Scalar::all(0.5)), {.black = 0, .white = 1}).type(),
            CV_8UC3);
}

TEST(GreyRange, NothingHasNoRange) {
  EXPECT_FALSE(vo::range_of({}));
  const std::vector<cv::Mat> plain{cv::Mat(4, 4, CV_16UC1, cv::Scalar(7))},
      one{cv::Mat(1, 1, CV_16UC1, cv::Scalar(7))};
  EXPECT_FALSE(vo::range_of(plain));
  EXPECT_FALSE(vo::range_of(one));
  cv::Mat depth = (cv::Mat_<float>(1, 3) << NAN, 1, 3);
  depth.at<float>(0) = std::numeric_limits<float>::infinity();
  const auto range = vo::range_of(std::vector<cv::Mat>{depth});
  ASSERT_TRUE(range);
  EXPECT_EQ(range->white, 3);
}

}  // namespace
