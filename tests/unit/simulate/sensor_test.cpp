#include "simulate/sensor.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace simulate {
namespace {

TEST(Sensor, AveragesExposures) {
  const cv::Mat dark(3, 4, CV_8UC3, cv::Scalar::all(10)), bright(3, 4, CV_8UC3, cv::Scalar::all(250));
  const cv::Mat mean = average({dark, bright, bright, bright});
  EXPECT_EQ(mean.type(), CV_8UC3);
  EXPECT_EQ(mean.at<cv::Vec3b>(1, 1), cv::Vec3b(190, 190, 190));
  EXPECT_EQ(cv::norm(average({dark}), dark, cv::NORM_INF), 0);
  EXPECT_THROW(average({}), std::invalid_argument);
}

TEST(Sensor, NoiseHasItsDeviationAndNoBias) {
  const cv::Mat clean(180, 320, CV_8UC3, cv::Scalar::all(128));
  cv::Mat noisy = clean.clone();
  add_noise(noisy, 4.5, 1);
  cv::Mat channel, difference;
  cv::extractChannel(noisy, channel, 1);
  cv::Scalar mean, deviation;
  cv::meanStdDev(channel, mean, deviation);
  // Rounding to grey levels adds 1/12 to the variance; rows share a table, hence no tighter than 3 %.
  EXPECT_NEAR(mean[0], 128, 0.15);
  EXPECT_NEAR(deviation[0], std::sqrt(4.5 * 4.5 + 1.0 / 12), 0.14);
  cv::Mat again = clean.clone(), other = clean.clone();
  add_noise(again, 4.5, 1);
  add_noise(other, 4.5, 2);
  EXPECT_EQ(cv::norm(noisy, again, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(noisy, other, cv::NORM_INF), 0);
}

TEST(Sensor, RaindropsOnlyLighten) {
  cv::Mat image(90, 160, CV_8UC3, cv::Scalar::all(100));
  add_raindrops(image, 30, 5);
  double low = 0, high = 0;
  cv::minMaxLoc(image.reshape(1), &low, &high);
  EXPECT_EQ(low, 100);
  EXPECT_GT(high, 110);
}

}  // namespace
}  // namespace simulate
