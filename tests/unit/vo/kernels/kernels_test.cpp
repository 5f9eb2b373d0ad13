#include "kernels/kernels.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using namespace vo::kernels;

/// The kernels other than the scalar ones that this processor runs.
std::vector<const Kernels*> others() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return {&avx2_kernels()};
#endif
  return {};
}

template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

class KernelsAgree : public testing::Test {
 protected:
  void SetUp() override {
    if (others().empty()) GTEST_SKIP() << "this processor runs the scalar kernels only";
  }
  std::vector<float> floats(std::size_t count, double low, double high) {
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(rng_.uniform(low, high));
    return values;
  }
  vo::Rng rng_{1};
};

TEST_F(KernelsAgree, OnHessianRows) {
  constexpr std::ptrdiff_t kStride = 150, kRows = 60;
  std::vector<std::uint32_t> integral(kStride * kRows + kLanes);
  for (auto& sum : integral) sum = static_cast<std::uint32_t>(rng_.index(1 << 20));
  for (const int lobe : {3, 5, 9}) {
    const int reach = (3 * lobe - 1) / 2;
    for (const int width : {1, 7, 8, 50, 140 - 2 * reach}) {
      const auto run = [&](const Kernels& kernels) {
        std::vector<std::uint32_t> scratch(3 * (kStride + kLanes));
        std::vector<float> out(kStride);
        kernels.hessian_row({.integral = integral.data() + kStride * (kRows / 2),
                             .stride = kStride,
                             .lobe_px = lobe,
                             .begin = reach,
                             .end = reach + width,
                             .scale = 1e-3F,
                             .scratch = scratch.data(),
                             .scratch_stride = kStride + kLanes,
                             .out = out.data()});
        out.resize(static_cast<std::size_t>(reach + width));
        return out;
      };
      const auto expected = run(scalar_kernels());
      for (const Kernels* kernels : others())
        EXPECT_TRUE(same_bits(run(*kernels), expected)) << lobe << ' ' << width;
    }
  }
}

TEST_F(KernelsAgree, OnMaxima) {
  // Few different values, so that there are ties.
  std::vector<std::vector<float>> rows(9, std::vector<float>(120));
  for (auto& row : rows) {
    for (float& value : row) value = static_cast<float>(rng_.index(5));
  }
  MaximaRow row{.begin = 1, .threshold = 3};
  for (std::size_t i = 0; i < 9; ++i) row.rows[i / 3][i % 3] = rows[i].data();
  std::size_t found = 0;
  for (const int end : {1, 2, 9, 60, 100}) {
    row.end = end;
    std::vector<int> expected(120), columns(120);
    const int count = scalar_kernels().maxima_row(row, expected.data());
    found += static_cast<std::size_t>(count);
    for (const Kernels* kernels : others()) {
      EXPECT_EQ(kernels->maxima_row(row, columns.data()), count);
      EXPECT_EQ(columns, expected);
    }
  }
  EXPECT_GT(found, 0U);
}

TEST_F(KernelsAgree, OnOrientationsAndDescriptors) {
  constexpr int kWidth = 60, kHeight = 40, kStride = kWidth + 1;
  std::vector<std::uint16_t> values(kStride * (kHeight + 1) + 1);
  for (auto& value : values) value = static_cast<std::uint16_t>(rng_.index(4081));
  const Raster raster{
      .values = values.data(), .stride = kStride, .last_column = kWidth - 1, .last_row = kHeight - 1};
  OrientationWeights orientation_weights{};
  for (auto& row : orientation_weights.values) {
    for (int c = 0; c < kOrientationRows; ++c) row[c] = static_cast<float>(rng_.uniform());
  }
  DescriptorWeights descriptor_weights{};
  for (auto& row : descriptor_weights.values) {
    for (int k = 0; k < kDescriptorSamples; ++k)
      row[k] = static_cast<float>(rng_.index(3) == 0 ? 0 : rng_.uniform());
  }
  for (int i = 0; i < 50; ++i) {
    // Some reach beyond the rim on every side.
    const auto at = floats(4, -1, 1);
    const Grid grid{.x = 30 + 35 * at[0],
                    .y = 20 + 25 * at[1],
                    .ux = 2 * at[2],
                    .uy = 2 * at[3],
                    .vx = -2 * at[3],
                    .vy = 2 * at[2]};
    const auto moments = [&](const Kernels& kernels) {
      OrientationMoments result;
      kernels.orientation_moments(raster, grid, orientation_weights, result);
      return std::vector<float>(std::begin(result.values), std::end(result.values));
    };
    const auto sums = [&](const Kernels& kernels, bool extended) {
      std::vector<float> result(extended ? 128 : 64);
      kernels.descriptor_sums(raster, grid, descriptor_weights, extended, result.data());
      return result;
    };
    for (const Kernels* kernels : others()) {
      EXPECT_TRUE(same_bits(moments(*kernels), moments(scalar_kernels())));
      EXPECT_TRUE(same_bits(sums(*kernels, false), sums(scalar_kernels(), false)));
      EXPECT_TRUE(same_bits(sums(*kernels, true), sums(scalar_kernels(), true)));
    }
  }
}

TEST_F(KernelsAgree, OnDistances) {
  for (const std::size_t size : {1U, 64U, 128U}) {
    const auto queries = floats(8 * size, -1, 1), references = floats(8 * size, -1, 1);
    const auto norms = floats(16, 0, 5), places = floats(32, 0, 100), limits = floats(8, 0, 3),
               minima = floats(8, 0, 3);
    for (const float reach : {50.0F, std::numeric_limits<float>::infinity()}) {
      const auto run = [&](const Kernels& kernels) {
        std::array<float[kLanes], kLanes> out;
        std::array<unsigned, kLanes> within;
        std::vector<float> result = minima;
        kernels.squared_distances(
            {.queries = {queries.data(), norms.data(), places.data(), places.data() + 8},
             .references = {references.data(), norms.data() + 8, places.data() + 16, places.data() + 24},
             .size = size,
             .squared_reach_px = reach * reach,
             .limits = limits.data(),
             .minima = result.data(),
             .out = out.data(),
             .within = within.data()});
        for (const auto& row : out) result.insert(result.end(), std::begin(row), std::end(row));
        for (const unsigned bits : within) result.push_back(static_cast<float>(bits));
        return result;
      };
      const auto expected = run(scalar_kernels());
      for (const Kernels* kernels : others()) EXPECT_TRUE(same_bits(run(*kernels), expected)) << size;
    }
  }
}

}  // namespace
