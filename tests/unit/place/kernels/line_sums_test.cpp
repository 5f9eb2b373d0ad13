#include "kernels/line_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

#if defined(__x86_64__)
void expect_to_equal_the_scalar_ones(const place::kernels::LineKernels& vectors) {
  const auto& scalar = place::kernels::scalar_line_kernels();
  vo::Rng rng(5);
  constexpr std::size_t kColumns = 100, kLines = 3;
  std::vector<std::uint32_t> rows(8 * kColumns);
  for (auto& value : rows) value = static_cast<std::uint32_t>(rng.bits());
  std::vector<float> costs(kColumns), factors(kLines * place::kernels::kChunk), terms(factors.size());
  for (auto& value : costs) value = static_cast<float>(rng.normal());
  for (std::size_t i = 0; i < factors.size(); ++i) {
    factors[i] = static_cast<float>(rng.uniform(0.1, 1));
    terms[i] = i % 5 == 0 ? std::numeric_limits<float>::infinity() : 0;
  }
  for (std::size_t count = 0; count < kColumns; count += 9) {
    std::vector<std::uint32_t> a(kColumns, 7), b(kColumns, 7);
    scalar.accumulate({costs.data(), 0.1F, 1000, rows.data(), a.data(), count});
    vectors.accumulate({costs.data(), 0.1F, 1000, rows.data(), b.data(), count});
    EXPECT_EQ(a, b);
    if (count > 0) {
      EXPECT_EQ(a[0], rows[0] + static_cast<std::uint32_t>(std::lrint((costs[0] - 0.1F) * 1000)));
    }
    EXPECT_EQ(a[count], 7U);  // nothing past the end
  }
  std::vector<place::kernels::RunEnds> ends;
  for (std::size_t i = 0; i < 4; ++i)
    ends.push_back({rows.data() + 2 * i * kColumns, rows.data() + (2 * i + 1) * kColumns});
  const std::vector<std::uint32_t> counts{1, 2, 1};
  const place::kernels::LineSums lines{ends.data(), counts.data(), kLines};
  for (const std::size_t column : {0, 3, 64}) {
    std::vector<float> a(place::kernels::kChunk), b(a), c(a), d(a);
    EXPECT_EQ(scalar.least(lines, column, 0.3F, a.data()), vectors.least(lines, column, 0.3F, b.data()));
    EXPECT_EQ(a, b);
    EXPECT_EQ(scalar.least_weighted(lines, column, factors.data(), terms.data(), c.data()),
              vectors.least_weighted(lines, column, factors.data(), terms.data(), d.data()));
    EXPECT_EQ(c, d);
    for (std::size_t k = 0; k < a.size(); ++k) {
      const auto run = [&](std::size_t i) { return ends[i].last[column + k] - ends[i].before[column + k]; };
      const std::int32_t least =
          std::min({static_cast<std::int32_t>(run(0)), static_cast<std::int32_t>(run(1) + run(2)),
                    static_cast<std::int32_t>(run(3))});
      EXPECT_EQ(a[k], static_cast<float>(least) * 0.3F);
    }
  }
}

TEST(LineKernels, OfAvx2EqualTheScalarOnes) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  expect_to_equal_the_scalar_ones(place::kernels::avx2_line_kernels());
}

TEST(LineKernels, OfAvx512EqualTheScalarOnes) {
  if (!__builtin_cpu_supports("avx512f")) GTEST_SKIP() << "no AVX-512";
  expect_to_equal_the_scalar_ones(place::kernels::avx512_line_kernels());
}
#endif

}  // namespace
