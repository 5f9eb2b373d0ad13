#include "kernels/dot_product.hpp"

#include <cmath>
#include <cstring>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using namespace place::kernels;
using testing::Each;
using testing::ElementsAre;

/// Every kernel that this processor runs.
std::vector<const DotKernels*> all_kernels() {
  std::vector<const DotKernels*> all{&scalar_dot_kernels(), &dot_kernels()};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) all.push_back(&avx2_dot_kernels());
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw")) {
    all.push_back(&avx512_dot_kernels());
    if (__builtin_cpu_supports("avx512vnni")) all.push_back(&vnni_dot_kernels());
  }
#endif
  return all;
}

std::vector<std::int8_t> random_rows(std::size_t values, std::uint64_t seed) {
  vo::Rng rng(seed);
  std::vector<std::int8_t> rows(values);
  for (std::int8_t& value : rows) value = static_cast<std::int8_t>(static_cast<int>(rng.index(255)) - 127);
  return rows;
}

/// The sums of a tile over [begin, begin + size) of both sides, as a caller makes them: starting from the
/// opposite of what queries of zeros give, plus 10.
std::vector<std::int32_t> sums_of(const DotKernels& kernel, const SignedRows& queries,
                                  const SignedRows& references, std::size_t begin, std::size_t size) {
  const auto packed = [&](const SignedRows& rows, std::size_t lanes, auto pack) {
    // What lies past the end may be fetched, not used.
    std::vector<std::uint8_t> bytes(packed_bytes(kernel.packing, lanes, rows.size));
    pack(kernel.packing, rows, lanes, bytes.data());
    return bytes;
  };
  const auto left = packed(queries, kernel.queries, pack_left);
  const auto zeros = packed({nullptr, 0, queries.size}, kernel.queries, pack_left);
  const auto right = packed(references, kernel.references, pack_right);
  std::vector<std::int32_t> start(kernel.references, 0), sums(kernel.queries * kernel.references);
  const auto multiply = [&](const std::vector<std::uint8_t>& of) {
    kernel.multiply({of.data() + packed_bytes(kernel.packing, kernel.queries, begin),
                     right.data() + packed_bytes(kernel.packing, kernel.references, begin), size,
                     start.data(), sums.data()});
  };
  multiply(zeros);
  for (std::size_t j = 0; j < start.size(); ++j) start[j] = 10 - sums[j];
  multiply(left);
  return sums;
}

TEST(DotKernels, EqualTheSumForAnyStretchAndCount) {
  constexpr std::size_t kSize = 96;
  const auto left = random_rows(20 * kSize, 1), right = random_rows(64 * kSize, 2);
  for (const DotKernels* kernel : all_kernels()) {
    for (const auto& [begin, size] :
         {std::pair<std::size_t, std::size_t>{0, kSize}, {0, 4}, {8, 76}, {92, 4}}) {
      for (const std::size_t missing : {std::size_t{0}, kernel->queries / 2}) {
        const SignedRows queries{left.data(), kernel->queries - missing, kSize};
        const SignedRows references{right.data(), kernel->references - (missing > 0 ? 1 : 0), kSize};
        const auto sums = sums_of(*kernel, queries, references, begin, size);
        for (std::size_t i = 0; i < kernel->queries; ++i) {
          for (std::size_t j = 0; j < kernel->references; ++j) {
            std::int32_t expected = 10;
            for (std::size_t k = begin; k < begin + size && i < queries.count && j < references.count; ++k)
              expected += left[i * kSize + k] * right[j * kSize + k];
            ASSERT_EQ(sums[i * kernel->references + j], expected)
                << kernel->references << ' ' << i << ' ' << j;
          }
        }
      }
    }
  }
}

/// The largest products there are, of all signs, over the largest descriptors there may be.
TEST(DotKernels, DoNotOverflow) {
  constexpr std::size_t kSize = 130'000;
  const std::vector<std::int8_t> most(kSize, 127), least(kSize, -127);
  for (const DotKernels* kernel : all_kernels()) {
    constexpr std::int32_t kSum = 130'000 * 127 * 127;
    for (const auto& [query, reference, sum] :
         {std::tuple{most, most, kSum}, {least, least, kSum}, {most, least, -kSum}, {least, most, -kSum}}) {
      EXPECT_EQ(sums_of(*kernel, {query.data(), 1, kSize}, {reference.data(), 1, kSize}, 0, kSize)[0],
                sum + 10);
    }
  }
}

/// Three shifts of one query: 0.5 * 0.5 * {1, -2, 3} of 4, so a largest cosine of 0.75; and its tie-breaking
/// to a whole number of units.
TEST(DotKernels, TakeTheCostOfTheLargestCosine) {
  for (const DotKernels* kernel : all_kernels()) {
    const std::size_t wide = kernel->references;
    std::vector<std::int32_t> sums;
    for (const int sum : {1, -2, 3}) sums.insert(sums.end(), wide, sum);
    const std::vector<float> query_scales{0.5F, 0.5F, 0.5F}, reference_scales(3 * wide, 0.5F);
    std::vector<float> costs(wide + 1, -1);
    kernel->costs({sums.data(), wide, 3, query_scales.data(), reference_scales.data(), costs.data()});
    EXPECT_EQ(costs.back(), -1);
    costs.pop_back();
    EXPECT_THAT(costs, Each(0.25F));
    // 1 - 2.5 / 2^15 and 1 - 3.5 / 2^15 lie between two multiples of 2^-15: the even one is taken.
    for (const auto& [fraction, units] : {std::pair{2.5F, 32766.0F}, {3.5F, 32764.0F}}) {
      const float scale = fraction / kCostUnits;
      const std::vector<std::int32_t> one(wide, 1);
      const std::vector<float> of_references(wide, scale);
      const float of_query = 1;
      kernel->costs({one.data(), wide, 1, &of_query, of_references.data(), costs.data()});
      EXPECT_THAT(costs, Each(units / kCostUnits));
    }
  }
}

/// Lags of the even columns 7, 5, 3 and of the odd ones 4, 9, 2, so D(-2, 0, 2) = 11, 14, 5; with X(-1) = 20
/// and X(0) = 30, D(-1) = 20 - 4 - 5 = 11 and D(1) = 30 - 9 - 3 = 18. A = lag -1 - (B + C) / 2 and so on.
TEST(DotKernels, MakeFiveShiftsOfTenSums) {
  const auto ten = [](int b_even, int c_even, int b_odd, int c_odd) {
    const int even = (b_even + c_even) / 2, odd = (b_odd + c_odd) / 2;
    return std::vector<int>{7 - even, b_even, c_even, even - 3, 4 - odd, b_odd, c_odd, odd - 2, 20, 30};
  };
  // B - C is twice the lag 0: 10 and 18.
  const std::vector<int> which = ten(8, -2, 11, -7);
  for (const DotKernels* kernel : all_kernels()) {
    const std::size_t wide = kernel->references;
    std::vector<std::int32_t> sums;
    for (const int sum : which) sums.insert(sums.end(), wide, sum);
    const std::vector<float> reference_scales(5 * wide, 1.0F / 64);
    std::vector<float> costs(wide);
    std::vector<float> found;
    for (std::size_t shift = 0; shift < 5; ++shift) {
      std::vector<float> query_scales(5, 0);
      query_scales[shift] = 1;
      kernel->costs_of_five(
          {sums.data(), wide, 5, query_scales.data(), reference_scales.data(), costs.data()});
      EXPECT_THAT(costs, Each(costs[0]));
      found.push_back((1 - costs[0]) * 64);
    }
    EXPECT_THAT(found, ElementsAre(11, 11, 14, 18, 5));
  }
}

TEST(DotKernels, GiveTheSameCosts) {
  const auto& scalar = scalar_dot_kernels();
  vo::Rng rng(5);
  for (const DotKernels* kernel : all_kernels()) {
    const std::size_t wide = kernel->references;
    std::vector<std::int32_t> sums(10 * wide);
    for (std::int32_t& sum : sums) sum = static_cast<std::int32_t>(rng.index(2'000'000'000)) - 1'000'000'000;
    std::vector<float> query_scales(5), reference_scales(5 * wide), costs(wide);
    for (float& scale : query_scales) scale = static_cast<float>(rng.uniform(1e-5, 4e-5));
    for (float& scale : reference_scales) scale = static_cast<float>(rng.uniform(1e-5, 4e-5));
    for (const bool of_five : {false, true}) {
      (of_five ? kernel->costs_of_five : kernel->costs)(
          {sums.data(), wide, 5, query_scales.data(), reference_scales.data(), costs.data()});
      for (std::size_t j = 0; j < wide; ++j) {
        std::vector<std::int32_t> own_sums(10);
        std::vector<float> own_scales(5);
        for (std::size_t i = 0; i < 10; ++i) own_sums[i] = sums[i * wide + j];
        for (std::size_t i = 0; i < 5; ++i) own_scales[i] = reference_scales[i * wide + j];
        float expected = 0;
        (of_five ? scalar.costs_of_five
                 : scalar.costs)({own_sums.data(), 1, 5, query_scales.data(), own_scales.data(), &expected});
        ASSERT_EQ(costs[j], expected);
      }
    }
  }
}

}  // namespace
