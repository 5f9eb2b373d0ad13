#include "simulate/texture.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace simulate {
namespace {

TEST(Texture, HalvesDownToOneTexel) {
  const Texture texture(cv::Mat(5, 12, CV_8UC4, cv::Scalar(10, 20, 30, 255)));
  ASSERT_EQ(texture.level_count(), 5);  // 12x5, 6x3, 3x2, 2x1, 1x1
  EXPECT_EQ(texture.level(1).width, 6);
  EXPECT_EQ(texture.level(1).height, 3);
  EXPECT_EQ(texture.level(4).width, 1);
  EXPECT_EQ(*texture.level(4).texels, 0xff1e140aU);  // the mean of a constant
  EXPECT_TRUE(texture.opaque());
}

TEST(Texture, RepeatsItsLastColumnAndRow) {
  cv::Mat4b image(2, 2);
  image << cv::Vec4b(1, 0, 0, 0), cv::Vec4b(2, 0, 0, 0), cv::Vec4b(3, 0, 0, 0), cv::Vec4b(4, 0, 0, 0);
  const Texture texture(image);
  const std::uint32_t* texels = texture.level(0).texels;
  const std::uint32_t expected[] = {1, 2, 2, 3, 4, 4, 3, 4, 4};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(texels[i], expected[i]) << i;
  EXPECT_FALSE(texture.opaque());
}

TEST(Texture, RefusesOtherImages) {
  EXPECT_THROW(Texture{cv::Mat()}, std::invalid_argument);
  EXPECT_THROW(Texture{cv::Mat(2, 2, CV_8UC3)}, std::invalid_argument);
}

}  // namespace
}  // namespace simulate
