#include "support/random_images.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/cost_matrix.hpp>
#include <vo/base/parallel.hpp>
#include <vo/image/patch_normalisation.hpp>

namespace {

using test_support::random_images;
using testing::Each;
using testing::ElementsAre;

TEST(CostMatrix, WorkedExample) {
  // Two pixels: 16 + 0 and 16 + 32 steps, 16 steps to a deviation.
  const vo::ImageStack query{.width = 2, .height = 1, .pixels = {128, 144}};
  const vo::ImageStack references{.width = 2, .height = 1, .pixels = {144, 144, 112, 176, 128, 144}};
  const auto matrix = place::cost_matrix(query, references);
  EXPECT_EQ(matrix.queries, 1U);
  EXPECT_EQ(matrix.references, 3U);
  EXPECT_THAT(matrix.values, ElementsAre(0.5F, 1.5F, 0.0F));
}

TEST(CostMatrix, EqualsTheDefinition) {
  // More queries than a band and more references than a block, neither a multiple.
  const auto queries = random_images(5, 3, 37, 1);
  const auto references = random_images(5, 3, 521, 2);
  const auto matrix = place::cost_matrix(queries, references);
  ASSERT_EQ(matrix.values.size(), 37U * 521);
  for (std::size_t q = 0; q < 37; ++q) {
    for (std::size_t r = 0; r < 521; ++r) {
      int sum = 0;
      for (std::size_t k = 0; k < 15; ++k) sum += std::abs(queries[q][k] - references[r][k]);
      // One float rounding of the product and one of the constant: equal to four units in the last place.
      ASSERT_FLOAT_EQ(matrix.at(q, r), static_cast<float>(sum) / (16.0F * 15.0F)) << q << ", " << r;
      ASSERT_EQ(matrix.row(q)[r], matrix.at(q, r));
    }
  }
}

/// The sum of absolute differences where a query moved by `shift` lies on the reference.
int overlap_sum(std::span<const std::uint8_t> query, std::span<const std::uint8_t> reference, int width,
                int height, int shift) {
  int sum = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = std::max(0, -shift); x < width - std::max(0, shift); ++x) {
      sum += std::abs(query[static_cast<std::size_t>(y * width + x + shift)] -
                      reference[static_cast<std::size_t>(y * width + x)]);
    }
  }
  return sum;
}

TEST(CostMatrix, JudgesEachShiftOnItsOwnOverlap) {
  // More queries than a band holds, more references than a block.
  constexpr int kWidth = 9, kHeight = 4;
  const auto queries = random_images(kWidth, kHeight, 40, 4),
             references = random_images(kWidth, kHeight, 140, 5);
  double centre = 0;  // of pairs of 64 references of the 140
  for (std::size_t i = 0; i < 64; ++i) {
    for (std::size_t j = 0; j < 64; ++j)
      centre += overlap_sum(references[i * 140 / 64], references[j * 140 / 64], kWidth, kHeight, 0);
  }
  centre /= 64 * 63;
  for (const int most : {1, 3, 8}) {
    const auto matrix = place::cost_matrix(queries, references, {.max_shift_px = most});
    for (std::size_t q = 0; q < 40; ++q) {
      for (std::size_t r = 0; r < 140; ++r) {
        double least = std::numeric_limits<double>::infinity();
        for (int shift = -most; shift <= most; ++shift) {
          const double root = std::sqrt(1 - std::abs(shift) / static_cast<double>(kWidth));
          const double sum = overlap_sum(queries[q], references[r], kWidth, kHeight, shift);
          least = std::min(least, sum / root + centre * (1 - root));
        }
        // To half a unit of the rounding, and a little for that of floats.
        ASSERT_NEAR(matrix.at(q, r) * 16 * kWidth * kHeight, least, 0.51) << most;
      }
    }
  }
}

TEST(CostMatrix, OfAViewMovedSidewaysIsThatOfTheOverlap) {
  // A row of 16 pixels seen from 2 pixels further right, and one reference, so that there is no other to take
  // the mean difference from.
  const auto wide = random_images(18, 1, 1, 6);
  const vo::ImageStack here{16, 1, {wide.pixels.begin(), wide.pixels.end() - 2}};
  const vo::ImageStack right{16, 1, {wide.pixels.begin() + 2, wide.pixels.end()}};
  for (const auto& [a, b] : {std::pair{here, right}, {right, here}}) {
    EXPECT_GT(place::cost_matrix(a, b).values[0], 0);
    EXPECT_GT(place::cost_matrix(a, b, {.max_shift_px = 1}).values[0], 0);
    EXPECT_EQ(place::cost_matrix(a, b, {.max_shift_px = 2}).values[0], 0);
    EXPECT_EQ(place::cost_matrix(a, b, {.max_shift_px = 15}).values[0], 0);
  }
}

TEST(CostMatrix, RefusesAShiftThatLeavesNoColumn) {
  const auto images = random_images(6, 2, 1, 1);
  EXPECT_NO_THROW(place::cost_matrix(images, images, {.max_shift_px = 5}));
  EXPECT_THROW(place::cost_matrix(images, images, {.max_shift_px = 6}), std::invalid_argument);
  EXPECT_THROW(place::cost_matrix(images, images, {.max_shift_px = -1}), std::invalid_argument);
}

TEST(ThumbnailCosts, GiveBlocksOfTheMatrix) {
  const auto queries = random_images(8, 4, 23, 1), references = random_images(8, 4, 300, 2);
  for (const int most : {0, 2}) {
    const auto matrix = place::cost_matrix(queries, references, {.max_shift_px = most});
    const place::ThumbnailCosts source(queries, references, {.max_shift_px = most});
    for (std::size_t q = 0; q < 23; q += 7) {
      for (std::size_t r = 0; r < 300; r += 130) {
        const std::size_t tall = std::min<std::size_t>(7, 23 - q), wide = std::min<std::size_t>(130, 300 - r);
        constexpr std::size_t kStride = 150;
        constexpr float kUntouched = -1;
        std::vector<float> some(tall * kStride, kUntouched);
        const place::Costs block{q, tall, r, wide, some.data(), kStride};
        source.compute(block);
        for (std::size_t i = 0; i < tall; ++i) {
          EXPECT_TRUE(std::ranges::equal(block.row(i), matrix.row(q + i).subspan(r, wide)));
          EXPECT_THAT(std::span(some).subspan(i * kStride + wide, kStride - wide), Each(kUntouched));
        }
      }
    }
    for (const float cost : matrix.values) {
      const float units = std::round(cost / source.unit());
      EXPECT_EQ(units * source.unit(), cost);
    }
  }
}

TEST(CostMatrix, OfAWalkWithItselfIsSymmetricAndZeroOnTheDiagonal) {
  const auto walk = random_images(8, 8, 40, 3);
  const auto matrix = place::cost_matrix(walk, walk);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(matrix.at(i, i), 0);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(matrix.at(i, j), matrix.at(j, i));
      EXPECT_GT(matrix.at(i, j), 0);
    }
  }
}

TEST(CostMatrix, OfEmptyStacksIsEmpty) {
  const auto none = random_images(4, 4, 0, 1), some = random_images(4, 4, 3, 1);
  EXPECT_EQ(place::cost_matrix(none, some).queries, 0U);
  EXPECT_EQ(place::cost_matrix(some, none).queries, 3U);
  EXPECT_TRUE(place::cost_matrix(some, none).values.empty());
  EXPECT_TRUE(place::cost_matrix(none, none).values.empty());
}

TEST(CostMatrix, RefusesDescriptorsOfTwoSizes) {
  EXPECT_THROW(place::cost_matrix(random_images(4, 2, 1, 1), random_images(2, 4, 1, 1)),
               std::invalid_argument);
}

TEST(CostMatrix, IsTheSameForAnyThreadCount) {
  const auto queries = random_images(16, 8, 50, 1), references = random_images(16, 8, 70, 2);
  vo::set_thread_count(1);
  const auto one = place::cost_matrix(queries, references);
  vo::set_thread_count(4);
  EXPECT_EQ(place::cost_matrix(queries, references).values, one.values);
  vo::set_thread_count(0);
}

}  // namespace
