#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>
#include <vo/image/patch_normalisation.hpp>

namespace {

using testing::Each;

std::vector<std::uint8_t> noise(std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  std::vector<std::uint8_t> values(count);
  for (auto& value : values) value = static_cast<std::uint8_t>(rng.index(256));
  return values;
}

/// The definition's floor: the median deviation of the grid's cells, times min_contrast.
double contrast_floor(const std::vector<std::uint8_t>& image, int width, int height,
                      const vo::PatchNormalisationOptions& options) {
  std::vector<double> deviations;
  const int p = options.patch_px;
  for (int y0 = 0; y0 < height; y0 += p) {
    for (int x0 = 0; x0 < width; x0 += p) {
      std::vector<double> cell;
      for (int y = y0; y < std::min(height, y0 + p); ++y) {
        for (int x = x0; x < std::min(width, x0 + p); ++x)
          cell.push_back(image[static_cast<std::size_t>(y * width + x)]);
      }
      const auto n = static_cast<double>(cell.size());
      double mean = 0, square = 0;
      for (const double value : cell) mean += value / n;
      for (const double value : cell) square += (value - mean) * (value - mean) / n;
      deviations.push_back(std::sqrt(square));
    }
  }
  std::ranges::sort(deviations);
  return options.min_contrast * deviations[deviations.size() / 2];
}

/// SSS Eq. 2 written down directly.
float brute_force(const std::vector<std::uint8_t>& image, int width, int height, int x, int y,
                  const vo::PatchNormalisationOptions& options) {
  const int p = options.patch_px;
  const bool grid = options.shape == vo::PatchShape::kGrid;
  const int x0 = grid ? x / p * p : std::max(0, x - p / 2);
  const int y0 = grid ? y / p * p : std::max(0, y - p / 2);
  const int x1 = grid ? x0 + p : std::min(width, x + p / 2 + 1);
  const int y1 = grid ? y0 + p : std::min(height, y + p / 2 + 1);
  double mean = 0, square = 0;
  const double n = static_cast<double>(x1 - x0) * (y1 - y0);
  for (int j = y0; j < y1; ++j) {
    for (int i = x0; i < x1; ++i) mean += image[static_cast<std::size_t>(j * width + i)] / n;
  }
  for (int j = y0; j < y1; ++j) {
    for (int i = x0; i < x1; ++i)
      square += std::pow(image[static_cast<std::size_t>(j * width + i)] - mean, 2) / n;
  }
  return static_cast<float>(
      (image[static_cast<std::size_t>(y * width + x)] - mean) /
      std::max({std::sqrt(square), options.min_deviation, contrast_floor(image, width, height, options)}));
}

TEST(PatchNormalise, WorkedExample) {
  // Mean 4, population deviation 2: -1, -1, 1, 1 deviations.
  const std::vector<std::uint8_t> image{2, 2, 6, 6};
  std::vector<float> z(4);
  const vo::PatchNormalisationOptions options{.patch_px = 2, .min_contrast = 0};
  vo::patch_normalise(image, 2, 2, options, z);
  EXPECT_THAT(z, testing::ElementsAre(-1, -1, 1, 1));
  const vo::ImageStack bytes =
      vo::patch_normalise({.width = 2, .height = 2, .pixels = {image.begin(), image.end()}}, options);
  EXPECT_THAT(bytes.pixels, testing::ElementsAre(112, 112, 144, 144));
}

TEST(PatchNormalise, EqualsTheDefinition) {
  constexpr int kWidth = 24, kHeight = 16;
  const auto image = noise(kWidth * kHeight, 3);
  for (const auto shape : {vo::PatchShape::kGrid, vo::PatchShape::kWindow}) {
    for (const double min_contrast : {0.0, 1.0, 1.25}) {
      SCOPED_TRACE(min_contrast);
      const vo::PatchNormalisationOptions options{
          .patch_px = 8, .shape = shape, .min_contrast = min_contrast};
      std::vector<float> z(image.size());
      vo::patch_normalise(image, kWidth, kHeight, options, z);
      float worst = 0;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          worst = std::max(worst, std::abs(z[static_cast<std::size_t>(y * kWidth + x)] -
                                           brute_force(image, kWidth, kHeight, x, y, options)));
        }
      }
      EXPECT_LT(worst, 1e-5);  // both are right to float rounding of values below 8
    }
  }
}

TEST(PatchNormalise, DoesNotBlowUpAFlatPatchBesideContrast) {
  // Four cells of 2x2: three of deviation 8 and one of deviation 2, which is divided by 1.25 * 8 all the
  // same.
  const std::vector<std::uint8_t> image{92, 92, 92, 92, 108, 108, 108, 108,
                                        92, 92, 98, 98, 108, 108, 102, 102};
  std::vector<float> z(16);
  vo::patch_normalise(image, 4, 4, {.patch_px = 2, .min_contrast = 1.25}, z);
  EXPECT_THAT(
      z, testing::Pointwise(testing::FloatEq(), {-0.8F, -0.8F, -0.8F, -0.8F, 0.8F, 0.8F, 0.8F, 0.8F, -0.8F,
                                                 -0.8F, -0.2F, -0.2F, 0.8F, 0.8F, 0.2F, 0.2F}));
}

TEST(PatchNormalise, GivesTheNeutralValueWithoutTexture) {
  const std::vector<std::uint8_t> black(16 * 16, 0);
  for (const auto shape : {vo::PatchShape::kGrid, vo::PatchShape::kWindow}) {
    std::vector<float> z(black.size(), 9);
    vo::patch_normalise(black, 16, 16, {.shape = shape}, z);
    EXPECT_THAT(z, Each(0.0F));
    const auto bytes = vo::patch_normalise(
        {.width = 16, .height = 16, .pixels = {black.begin(), black.end()}}, {.shape = shape});
    EXPECT_THAT(bytes.pixels, Each(vo::kNeutralByte));
  }
}

TEST(PatchNormalise, DoesNotSeeBrightnessOrContrast) {
  // Even values up to 120, so that twice and half of them are exact bytes and no patch is flat.
  std::vector<std::uint8_t> image = noise(64, 5);
  for (auto& value : image) value = static_cast<std::uint8_t>(value / 4 * 2);
  std::vector<std::uint8_t> brighter = image;
  for (auto& value : brighter) value = static_cast<std::uint8_t>(value / 2 + 100);
  std::vector<float> a(64), b(64);
  vo::patch_normalise(image, 8, 8, {}, a);
  vo::patch_normalise(brighter, 8, 8, {}, b);
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-5);  // float rounding
}

TEST(PatchNormalise, BytesAreTheDeviationsRounded) {
  // One bright pixel among 63: the largest deviation there is, sqrt(63) = 7.94, still fits.
  std::vector<std::uint8_t> image(64, 0);
  image[20] = 255;
  const auto bytes = vo::patch_normalise({.width = 8, .height = 8, .pixels = {image.begin(), image.end()}},
                                         {.min_contrast = 0});
  EXPECT_EQ(bytes.pixels[20], 255);
  EXPECT_EQ(bytes.pixels[0], 126);  // -1 / sqrt(63) = -0.126 deviations = -2.02 steps
}

TEST(PatchNormalise, IsTheSameForAnyThreadCount) {
  const auto pixels = noise(16 * 8 * 50, 11);
  const vo::ImageStack images{.width = 16, .height = 8, .pixels = {pixels.begin(), pixels.end()}};
  vo::set_thread_count(1);
  const auto one = vo::patch_normalise(images, {});
  vo::set_thread_count(4);
  EXPECT_EQ(vo::patch_normalise(images, {}).pixels, one.pixels);
  vo::set_thread_count(0);
}

TEST(PatchNormalise, RefusesSizesThatDoNotFit) {
  const std::vector<std::uint8_t> image(20 * 8);
  std::vector<float> z(image.size());
  EXPECT_THROW(vo::patch_normalise(image, 20, 8, {.patch_px = 8}, z), std::invalid_argument);
  EXPECT_NO_THROW(vo::patch_normalise(image, 20, 8, {.patch_px = 8, .shape = vo::PatchShape::kWindow}, z));
  EXPECT_THROW(vo::patch_normalise(image, 21, 8, {.patch_px = 8}, z), std::invalid_argument);
  EXPECT_THROW(vo::patch_normalise(image, 20, 8, {.patch_px = 1}, z), std::invalid_argument);
  EXPECT_TRUE(vo::patch_normalise(vo::ImageStack{.width = 64, .height = 32, .pixels = {}}, {}).empty());
}

TEST(PatchContrast, IsTheMedianDeviationOfTheCells) {
  // Four cells of 2x2 each: flat, 0/10 (deviation 5), 0/20 (10), 0/40 (20); the upper of the middle two.
  const std::vector<std::uint8_t> row{9, 9, 0, 10, 0, 20, 0, 40};
  vo::ImageStack images = vo::make_image_stack(8, 2, 2);  // the second stays flat
  std::ranges::copy(row, images.pixels.begin());
  std::ranges::copy(row, images.pixels.begin() + 8);
  EXPECT_THAT(vo::patch_contrast(images, 2), testing::ElementsAre(10, 0));
  EXPECT_THAT(vo::patch_contrast({.width = 8, .height = 8, .pixels = {}}, 8), testing::IsEmpty());
  EXPECT_THROW(vo::patch_contrast(images, 1), std::invalid_argument);
}

}  // namespace
