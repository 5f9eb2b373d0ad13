#include "kernels/absolute_difference.hpp"

#include "support/random_images.hpp"

#include <cstdlib>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using test_support::random_images;
using testing::Each;

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
          kernel({all_queries.pixels.data(), queries}, {all_references.pixels.data(), references},
                 {size, size}, {0.1F, sums.data(), stride});
          ASSERT_EQ(sums, expected);
        }
      }
    }
  }
}

/// Images of 200 bytes of which some in the middle are compared, others for queries than for references.
TEST(AbsoluteDifferenceKernels, CompareAPartOfImages) {
  constexpr std::size_t kStride = 200;
  const auto queries = random_images(static_cast<int>(kStride), 1, 13, 1);
  const auto references = random_images(static_cast<int>(kStride), 1, 9, 2);
  for (const auto& [query_from, reference_from, size] :
       {std::tuple<std::size_t, std::size_t, std::size_t>{0, 64, 136},
        {70, 0, 130},
        {33, 34, 1},
        {100, 36, 100}}) {
    std::vector<float> expected;
    for (std::size_t i = 0; i < 13; ++i) {
      for (std::size_t j = 0; j < 9; ++j) {
        int sum = 0;
        for (std::size_t k = 0; k < size; ++k)
          sum += std::abs(queries[i][query_from + k] - references[j][reference_from + k]);
        expected.push_back(static_cast<float>(sum));
      }
    }
    for (const auto kernel : kernels()) {
      std::vector<float> sums(expected.size());
      kernel({queries.pixels.data() + query_from, 13}, {references.pixels.data() + reference_from, 9},
             {size, kStride}, {1, sums.data(), 9});
      ASSERT_EQ(sums, expected);
    }
  }
}

TEST(AbsoluteDifferenceKernels, DoNotOverflow) {
  // The largest difference there is, over an image much larger than a thumbnail: 255 * 100003.
  constexpr std::size_t kSize = 100003;
  const std::vector<std::uint8_t> bright(kSize, 255), dark(7 * kSize, 0);
  for (const auto kernel : kernels()) {
    std::vector<float> sums(7);
    kernel({bright.data(), 1}, {dark.data(), 7}, {kSize, kSize}, {1, sums.data(), 7});
    EXPECT_THAT(sums, Each(25500765.0F));
    kernel({dark.data(), 7}, {bright.data(), 1}, {kSize, kSize},
           {1, sums.data(), 1});  // and the other way round
    EXPECT_THAT(sums, Each(25500765.0F));
  }
}

}  // namespace
