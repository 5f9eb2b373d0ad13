#include "kernels/path_rows.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using place::kernels::ChunkTotals;
using place::kernels::PathKernels;

/// The fastest of this processor, which may be the plain one.
std::vector<const PathKernels*> tables() {
  return {&place::kernels::plain_path_kernels(), &place::kernels::path_kernels()};
}

std::vector<float> random_row(std::size_t count, double low, double high, std::uint64_t seed) {
  vo::Rng rng(seed);
  std::vector<float> row(count);
  for (float& value : row) value = static_cast<float>(rng.uniform(low, high));
  return row;
}

TEST(PathRows, LikelihoodsArePowersOfTwo) {
  for (const PathKernels* kernels : tables()) {
    const std::vector<float> costs = random_row(1000, -8, 8, 1);
    std::vector<float> out(costs.size());
    kernels->likelihoods(costs.data(), costs.size(), -1, 0.75F, 6, out.data());
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const double exact = std::exp2((-1 - std::clamp<double>(costs[i], -6, 6)) * 0.75);
      EXPECT_NEAR(out[i] / exact, 1, 4e-6) << costs[i];  // the header's claim
    }
  }
}

TEST(PathRows, AConvolutionIsItsSum) {
  // Small whole numbers: sums are exact.
  const std::vector<float> from{1, 2, 3, 4, 5, 6, 7}, taps{1, 10, 100, 1000, 10000};
  for (const PathKernels* kernels : tables()) {
    std::vector<float> to(3);
    kernels->convolve(from.data(), 3, taps.data(), 5, 0.5F, to.data());
    EXPECT_EQ(to, (std::vector<float>{54321.5F, 65432.5F, 76543.5F}));
    kernels->convolve(from.data(), 3, taps.data(), 2, 0.5F, to.data());
    EXPECT_EQ(to, (std::vector<float>{21.5F, 32.5F, 43.5F}));
    kernels->convolve(from.data(), 0, taps.data(), 4, 0.5F, to.data());  // nothing is touched
    EXPECT_EQ(to[0], 21.5F);
  }
}

TEST(PathRows, AProductHasItsSumAndItsHighest) {
  for (const PathKernels* kernels : tables()) {
    for (std::size_t count = 0; count < 70; ++count) {
      std::vector<float> a(count), b(count), out(count);
      float sum = 0, most = 0;
      for (std::size_t i = 0; i < count; ++i) {
        a[i] = static_cast<float>(i % 7);
        b[i] = static_cast<float>(i % 5);
        sum += a[i] * b[i];
        most = std::max(most, a[i] * b[i]);
      }
      const ChunkTotals totals = kernels->multiply_chunk(a.data(), b.data(), count, out.data());
      EXPECT_EQ(totals.sum, sum) << count;
      EXPECT_EQ(totals.most, most) << count;
      EXPECT_EQ(kernels->multiply(a.data(), b.data(), count, a.data()), sum) << count;
      EXPECT_EQ(a, out) << count;
    }
  }
}

TEST(PathRows, EveryInstructionSetGivesTheSameBytes) {
  const PathKernels& plain = place::kernels::plain_path_kernels();
  const PathKernels& fastest = place::kernels::path_kernels();
  for (const std::size_t count : {1U, 7U, 16U, 61U, 64U, 333U}) {
    const std::vector<float> a = random_row(count + 8, -7, 7, count), b = random_row(count, 0, 2, count + 1);
    std::vector<float> one(count), other(count);
    plain.likelihoods(a.data(), count, -1, 0.7F, 6, one.data());
    fastest.likelihoods(a.data(), count, -1, 0.7F, 6, other.data());
    EXPECT_EQ(one, other) << count;
    for (const std::size_t taps : {1U, 5U, 8U}) {
      plain.convolve(a.data(), count, b.data(), std::min<std::size_t>(taps, count), 0.1F, one.data());
      fastest.convolve(a.data(), count, b.data(), std::min<std::size_t>(taps, count), 0.1F, other.data());
      EXPECT_EQ(one, other) << count;
    }
    EXPECT_EQ(plain.multiply(a.data(), b.data(), count, one.data()),
              fastest.multiply(a.data(), b.data(), count, other.data()));
    EXPECT_EQ(one, other) << count;
    const ChunkTotals x = plain.multiply_chunk(b.data(), b.data(), count, one.data());
    const ChunkTotals y = fastest.multiply_chunk(b.data(), b.data(), count, other.data());
    EXPECT_EQ(x.sum, y.sum);
    EXPECT_EQ(x.most, y.most);
    EXPECT_EQ(one, other) << count;
  }
}

}  // namespace
