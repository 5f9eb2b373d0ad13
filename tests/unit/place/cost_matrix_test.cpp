#include "kernels/absolute_difference.hpp"
#include "support/random_images.hpp"

#include <cstdlib>
#include <stdexcept>
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
#endif
  return all;
}

TEST(AbsoluteDifferenceKernels, EqualTheSumForAnySizeAndCount) {
  for (const std::size_t size : {1, 3, 31, 32, 33, 63, 64, 65, 100, 2048}) {
    for (std::size_t count = 0; count <= 9; ++count) {
      SCOPED_TRACE(testing::Message() << size << " bytes, " << count << " references");
      const auto references = random_images(static_cast<int>(size), 1, count, 1);
      const auto query = random_images(static_cast<int>(size), 1, 1, 2);
      std::vector<std::uint32_t> expected(count, 0);
      for (std::size_t j = 0; j < count; ++j) {
        for (std::size_t k = 0; k < size; ++k)
          expected[j] += static_cast<std::uint32_t>(std::abs(query.pixels[k] - references[j][k]));
      }
      for (const auto kernel : kernels()) {
        // One place more than the kernel may write to.
        constexpr std::uint32_t kUntouched = 12345;
        std::vector<std::uint32_t> sums(count + 1, kUntouched);
        kernel(query.pixels.data(), references.pixels.data(), count, size, sums.data());
        EXPECT_EQ(sums.back(), kUntouched);
        sums.pop_back();
        EXPECT_EQ(sums, expected);
      }
    }
  }
}

TEST(AbsoluteDifferenceKernels, DoNotOverflow) {
  // The largest difference there is, over an image much larger than a thumbnail: 255 * 100003.
  constexpr std::size_t kSize = 100003;
  const std::vector<std::uint8_t> query(kSize, 255), references(5 * kSize, 0);
  for (const auto kernel : kernels()) {
    std::vector<std::uint32_t> sums(5);
    kernel(query.data(), references.data(), 5, kSize, sums.data());
    EXPECT_THAT(sums, Each(25500765U));
    kernel(references.data(), query.data(), 1, kSize, sums.data());  // and the other way round
    EXPECT_EQ(sums[0], 25500765U);
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
