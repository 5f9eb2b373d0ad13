#include "kernels/absolute_difference.hpp"
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

#include <place/cost_matrix.hpp>
#include <vo/base/parallel.hpp>
#include <vo/image/patch_normalisation.hpp>

namespace {

using test_support::random_images;
using testing::Each;
using testing::ElementsAre;

/// Every kernel that this processor runs.
std::vector<place::kernels::AbsoluteDifferenceKernel> kernels() {
  std::vector<place::kernels::AbsoluteDifferenceKernel> all{place::kernels::absolute_difference_scalar,
                                                            place::kernels::absolute_difference()};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) all.push_back(place::kernels::absolute_difference_avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
    all.push_back(place::kernels::absolute_difference_avx512);
#endif
  return all;
}

TEST(AbsoluteDifferenceKernels, EqualTheSumForAnySizeAndCount) {
  // Sizes around those of one and two registers of any kind; counts around those of a tile's sides.
  for (const std::size_t size : {1, 3, 15, 17, 31, 32, 33, 63, 64, 65, 100, 127, 128, 200, 2048}) {
    const auto all_queries = random_images(static_cast<int>(size), 1, 7, 1);
    const auto all_references = random_images(static_cast<int>(size), 1, 14, 2);
    for (std::size_t queries = 0; queries <= 7; ++queries) {
      for (std::size_t references = 0; references <= 14; ++references) {
        SCOPED_TRACE(testing::Message() << size << " bytes, " << queries << " x " << references);
        // Two places more in each row than the kernel may write to.
        constexpr float kUntouched = 0.5F;
        const std::size_t stride = references + 2;
        std::vector<float> expected(queries * stride, kUntouched);
        for (std::size_t i = 0; i < queries; ++i) {
          for (std::size_t j = 0; j < references; ++j) {
            int sum = 0;
            for (std::size_t k = 0; k < size; ++k) sum += std::abs(all_queries[i][k] - all_references[j][k]);
            expected[i * stride + j] = static_cast<float>(sum) * 0.1F;
          }
        }
        for (const auto kernel : kernels()) {
          std::vector<float> sums(queries * stride, kUntouched);
          kernel({all_queries.pixels.data(), queries}, {all_references.pixels.data(), references}, size,
                 {0.1F, sums.data(), stride});
          ASSERT_EQ(sums, expected);
        }
      }
    }
  }
}

TEST(AbsoluteDifferenceKernels, DoNotOverflow) {
  // The largest difference there is, over an image much larger than a thumbnail: 255 * 100003.
  constexpr std::size_t kSize = 100003;
  const std::vector<std::uint8_t> bright(kSize, 255), dark(7 * kSize, 0);
  for (const auto kernel : kernels()) {
    std::vector<float> sums(7);
    kernel({bright.data(), 1}, {dark.data(), 7}, kSize, {1, sums.data(), 7});
    EXPECT_THAT(sums, Each(25500765.0F));
    kernel({dark.data(), 7}, {bright.data(), 1}, kSize, {1, sums.data(), 1});  // and the other way round
    EXPECT_THAT(sums, Each(25500765.0F));
  }
}

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

/// The least over all shifts of the mean difference to the middle of the reference, by the definition.
float shifted_cost(std::span<const std::uint8_t> query, std::span<const std::uint8_t> reference, int width,
                   int height, int most) {
  int least = std::numeric_limits<int>::max();
  for (int shift = -most; shift <= most; ++shift) {
    int sum = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = most; x < width - most; ++x) {
        sum += std::abs(query[static_cast<std::size_t>(y * width + x + shift)] -
                        reference[static_cast<std::size_t>(y * width + x)]);
      }
    }
    least = std::min(least, sum);
  }
  return static_cast<float>(least) / (16.0F * static_cast<float>((width - 2 * most) * height));
}

TEST(CostMatrix, TakesTheLeastOverShifts) {
  // More queries than a band holds with their variants, more references than a block.
  const auto queries = random_images(9, 4, 40, 4), references = random_images(9, 4, 140, 5);
  for (const int most : {0, 1, 3, 4}) {
    const auto matrix = place::cost_matrix(queries, references, {.max_shift_px = most});
    for (std::size_t q = 0; q < 40; ++q) {
      for (std::size_t r = 0; r < 140; ++r)
        ASSERT_FLOAT_EQ(matrix.at(q, r), shifted_cost(queries[q], references[r], 9, 4, most)) << most;
    }
  }
}

TEST(CostMatrix, OfAViewMovedSidewaysIsZeroWithinTheShift) {
  // A row of 12 pixels seen from 2 pixels further right.
  const auto wide = random_images(14, 1, 1, 6);
  const vo::ImageStack here{12, 1, {wide.pixels.begin(), wide.pixels.end() - 2}};
  const vo::ImageStack right{12, 1, {wide.pixels.begin() + 2, wide.pixels.end()}};
  for (const auto& [a, b] : {std::pair{here, right}, {right, here}}) {
    EXPECT_GT(place::cost_matrix(a, b).values[0], 0);
    EXPECT_GT(place::cost_matrix(a, b, {.max_shift_px = 1}).values[0], 0);
    EXPECT_EQ(place::cost_matrix(a, b, {.max_shift_px = 2}).values[0], 0);
    EXPECT_EQ(place::cost_matrix(a, b, {.max_shift_px = 3}).values[0], 0);
  }
}

TEST(CostMatrix, RefusesAShiftThatLeavesNoColumn) {
  const auto images = random_images(6, 2, 1, 1);
  EXPECT_NO_THROW(place::cost_matrix(images, images, {.max_shift_px = 2}));
  EXPECT_THROW(place::cost_matrix(images, images, {.max_shift_px = 3}), std::invalid_argument);
  EXPECT_THROW(place::cost_matrix(images, images, {.max_shift_px = -1}), std::invalid_argument);
}

TEST(CostSource, GivesBlocksOfTheMatrix) {
  const auto queries = random_images(8, 4, 23, 1), references = random_images(8, 4, 300, 2);
  for (const int most : {0, 2}) {
    const auto matrix = place::cost_matrix(queries, references, {.max_shift_px = most});
    const place::CostSource source(queries, references, {.max_shift_px = most});
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
          EXPECT_THAT(std::span(some).subspan(i * kStride + wide, kStride - wide), testing::Each(kUntouched));
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
