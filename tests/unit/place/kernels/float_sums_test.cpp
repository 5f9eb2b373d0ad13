#include "kernels/float_sums.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using namespace place::kernels;
using testing::Each;

/// Every kernel that this processor runs.
std::vector<const FloatKernels*> all_kernels() {
  std::vector<const FloatKernels*> all{&scalar_float_kernels(), &float_kernels()};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) all.push_back(&avx2_float_kernels());
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
    all.push_back(&avx512_float_kernels());
#endif
  return all;
}

std::vector<float> random_values(std::size_t count, vo::Rng& rng) {
  std::vector<float> values(count);
  for (float& value : values) value = static_cast<float>(rng.normal());
  return values;
}

float term_of(Term term, float a, float b) {
  if (term == Term::kProduct) return a * b;
  const float difference = a - b;
  return term == Term::kAbsoluteDifference ? std::abs(difference) : difference * difference;
}

TEST(FloatKernels, AddTermsInTheOrderOfTheValues) {
  vo::Rng rng(1);
  for (const FloatKernels* kernel : all_kernels()) {
    for (const std::size_t size : {1, 7, 500}) {
      const auto queries = random_values(size * kernel->queries, rng),
                 references = random_values(size * kernel->references, rng);
      for (const Term term : {Term::kProduct, Term::kAbsoluteDifference, Term::kSquaredDifference}) {
        std::vector<float> sums(kernel->queries * kernel->references);
        kernel->add(term, {queries.data(), references.data(), size, sums.data()});
        for (std::size_t i = 0; i < kernel->queries; ++i) {
          for (std::size_t j = 0; j < kernel->references; ++j) {
            float expected = 0;
            for (std::size_t k = 0; k < size; ++k) {
              const float one =
                  term_of(term, queries[k * kernel->queries + i], references[k * kernel->references + j]);
              expected += one;
            }
            ASSERT_EQ(sums[i * kernel->references + j], expected);
          }
        }
      }
    }
  }
}

TEST(FloatKernels, MakeCosts) {
  for (const FloatKernels* kernel : all_kernels()) {
    const std::size_t wide = kernel->references;
    const std::vector<float> sums(wide, 9.0F), scales(wide, 0.125F);
    std::vector<float> costs(wide);
    const auto cost = [&](const float* reference_scales, float query_scale, bool root) {
      kernel->costs({sums.data(), reference_scales, query_scale, root, 16, costs.data()});
      EXPECT_THAT(costs, Each(costs[0]));
      return costs[0];
    };
    EXPECT_EQ(cost(scales.data(), 0.25F, false), 0.75F);  // 1 - 9/32 = 11.5/16: to the even one
    EXPECT_EQ(cost(scales.data(), 1.0F, false), 0.0F);    // 1 - 9/8 is below 0
    EXPECT_EQ(cost(nullptr, 0.5F, false), 4.5F);
    EXPECT_EQ(cost(nullptr, 1.0F, true), 3.0F);
  }
}

}  // namespace
