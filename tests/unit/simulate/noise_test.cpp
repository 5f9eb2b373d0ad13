#include "simulate/noise.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace simulate {
namespace {

TEST(Noise, IsAFunctionOfPlaceAndSeed) {
  EXPECT_EQ(lattice_hash(3, -7, 5), lattice_hash(3, -7, 5));
  EXPECT_NE(lattice_hash(3, -7, 5), lattice_hash(-7, 3, 5));
  EXPECT_NE(lattice_hash(3, -7, 5), lattice_hash(3, -7, 6));
}

TEST(Noise, UniformHasItsMeanAndSpread) {
  double sum = 0, square = 0;
  constexpr int kSide = 200;
  for (int y = -kSide / 2; y < kSide / 2; ++y) {
    for (int x = -kSide / 2; x < kSide / 2; ++x) {
      const double u = lattice_uniform(x, y, 1);
      ASSERT_GE(u, 0);
      ASSERT_LT(u, 1);
      sum += u;
      square += u * u;
    }
  }
  constexpr double kCount = kSide * kSide;
  // Five standard errors: the variance of u is 1/12, that of u^2 is 4/45.
  EXPECT_NEAR(sum / kCount, 0.5, 5 * std::sqrt(1.0 / 12 / kCount));
  EXPECT_NEAR(square / kCount, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / kCount));
}

TEST(Noise, IsContinuousAndMeetsItsLattice) {
  EXPECT_FLOAT_EQ(value_noise(-2, 5, 9), 2 * lattice_uniform(-2, 5, 9) - 1);
  for (float x = -3; x < 3; x += 0.37F) {
    // The steepest a smoothstep between -1 and 1 can be is 3 per unit.
    EXPECT_NEAR(value_noise(x, 0.3F, 9), value_noise(x + 1e-3F, 0.3F, 9), 3.1e-3);
  }
}

TEST(Noise, ImagesHaveTextureAtEveryScale) {
  const cv::Mat1f image = fractal_image({256, 256}, {64, 64}, 3);
  EXPECT_TRUE(cv::checkRange(image, true, nullptr, -1, 1 + 1e-6));
  for (const int step : {1, 4, 16, 64}) {
    const cv::Mat difference = image.colRange(step, 256) - image.colRange(0, 256 - step);
    // The finest of seven octaves carries 4 % of the weight; without it, neighbours would differ by half a
    // per cent.
    EXPECT_GT(cv::norm(difference, cv::NORM_L2) / 256, 0.02) << step;
  }
  EXPECT_EQ(fractal_image({1, 1}, {1, 1}, 3).size(), cv::Size(1, 1));
}

TEST(Noise, ImagesOfNeighbouringPartsMeet) {
  const cv::Mat1f whole = fractal_image({60, 40}, {13, 9}, 3, {-30, 7});
  const cv::Mat1f part = fractal_image({20, 10}, {13, 9}, 3, {-10, 19});
  // The same arithmetic but for the rounding of positions.
  EXPECT_LT(cv::norm(whole(cv::Rect(20, 12, 20, 10)), part, cv::NORM_INF), 1e-5);
}

}  // namespace
}  // namespace simulate
