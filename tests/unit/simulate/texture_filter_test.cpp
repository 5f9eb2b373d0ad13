#include "simulate/texture_filter.hpp"

#include <array>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vo/base/rng.hpp>

namespace simulate {
namespace {

int channel(Lanes lanes, int index) {
  return static_cast<int>(lanes >> (16 * index)) & 0xffff;
}

TEST(TextureFilter, BilinearMatchesTheSumByHand) {
  vo::Rng rng(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<std::uint32_t, 4> texels{};
    for (auto& texel : texels) texel = static_cast<std::uint32_t>(rng.bits());
    const int right = static_cast<int>(rng.index(16)), lower = static_cast<int>(rng.index(16));
    const Lanes mixed = bilinear(texels.data(), texels.data() + 2, right, lower);
    for (int c = 0; c < 4; ++c) {
      const auto byte = [&](std::size_t i) { return static_cast<int>(texels[i] >> (8 * c) & 255U); };
      const int expected = (byte(0) * (16 - right) * (16 - lower) + byte(1) * right * (16 - lower) +
                            byte(2) * (16 - right) * lower + byte(3) * right * lower) /
                           256;
      EXPECT_EQ(channel(mixed, c), expected);
    }
  }
}

cv::Mat ramp(cv::Size size) {
  cv::Mat4b image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      image(y, x) =
          cv::Vec4b(cv::saturate_cast<std::uint8_t>(2 * x), cv::saturate_cast<std::uint8_t>(3 * y), 0, 255);
  }
  return image;
}

TEST(TextureFilter, ReadsARampExactlyToItsRounding) {
  const Texture texture(ramp({100, 60}));
  const TextureFilter filter(texture, {0.005F, 0, 0, 0.008F}, 3);  // magnified: level 0 alone
  for (float u = 0.01F; u < 0.99F; u += 0.07F) {
    // A sixteenth of a texel is an eighth of a grey level; the result is rounded down.
    EXPECT_NEAR(channel(filter.sample(u, 0.5F), 0), 2 * (u * 100 - 0.5F), 1.2);
    EXPECT_NEAR(channel(filter.sample(0.5F, u), 1), 3 * (u * 60 - 0.5F), 1.2);
  }
  EXPECT_EQ(channel(filter.sample(-5, 0.5F), 0), 0);
  EXPECT_EQ(channel(filter.sample(5, 0.5F), 0), 198);
}

TEST(TextureFilter, AveragesWhatAPixelCovers) {
  cv::Mat4b checks(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x)
      checks(y, x) = (x + y) % 2 == 0 ? cv::Vec4b(200, 200, 200, 255) : cv::Vec4b(0, 0, 0, 255);
  }
  const Texture texture(checks);
  const TextureFilter filter(texture, {4.0F / 64, 0, 0, 4.0F / 64}, 3);
  // Four by four texels of a chequer board are grey; each level and each mix rounds down by at most one.
  for (float u = 0.1F; u < 0.9F; u += 0.13F) EXPECT_NEAR(channel(filter.sample(u, u), 0), 100, 3);
}

TEST(TextureFilter, MoreTapsKeepDetailAcrossASlant) {
  // Stripes along u, seen so that a pixel covers 12 texels of v but one of u: they are all there with three
  // taps.
  cv::Mat4b stripes(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x)
      stripes(y, x) = x % 8 < 4 ? cv::Vec4b(200, 200, 200, 255) : cv::Vec4b(0, 0, 0, 255);
  }
  const Texture texture(stripes);
  const auto contrast = [&](int taps) {
    const TextureFilter filter(texture, {1.0F / 64, 0, 0, 12.0F / 64}, taps);
    return channel(filter.sample(10.0F / 64, 0.5F), 0) - channel(filter.sample(14.0F / 64, 0.5F), 0);
  };
  EXPECT_GT(contrast(3), 2 * std::max(1, contrast(1)));
}

}  // namespace
}  // namespace simulate
