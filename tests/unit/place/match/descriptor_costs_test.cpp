#include "place/match/descriptor_costs.hpp"

#include "support/random_images.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/describe/quantise.hpp>
#include <place/match/cost_matrix.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::ColumnStack;
using place::descriptor_costs;
using place::Descriptors;
using place::FloatRows;

ColumnStack random_columns(int columns, int channels, std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  ColumnStack stack = place::make_column_stack(columns, channels, count);
  for (std::int8_t& value : stack.values)
    value = static_cast<std::int8_t>(static_cast<int>(rng.index(127)) - 63);
  return stack;
}

/// The definition of the shifted cosine, in double.
double shifted_cosine(const ColumnStack& a, std::size_t q, const ColumnStack& b, std::size_t r, int most) {
  double least = 2;
  for (int s = -most; s <= most; ++s) {
    double dot = 0, aa = 0, bb = 0;
    for (int j = 0; j < a.columns; ++j) {
      if (j + s < 0 || j + s >= a.columns) continue;
      for (int k = 0; k < a.channels; ++k) {
        const double x = a[q][static_cast<std::size_t>((j + s) * a.channels + k)],
                     y = b[r][static_cast<std::size_t>(j * a.channels + k)];
        dot += x * y;
        aa += x * x;
        bb += y * y;
      }
    }
    const double share = static_cast<double>(a.columns - std::abs(s)) / a.columns;
    least = std::min(least, 1 - std::sqrt(share) * dot / std::sqrt(aa * bb));
  }
  return least;
}

TEST(DescriptorCosts, OfColumnsAreTheShiftedCosine) {
  const ColumnStack a = random_columns(8, 7, 4, 1), b = random_columns(8, 7, 6, 2);
  // 16 of 64 pixels are 2 of 8 columns; without, the descriptor's own 1.
  const std::pair<std::optional<int>, int> cases[] = {{16, 2}, {std::nullopt, 1}, {0, 0}};
  for (const auto& [max_shift_px, columns] : cases) {
    const auto costs = cost_matrix(*descriptor_costs(a, b, {.max_shift = 1, .columns = 8}, max_shift_px));
    for (std::size_t q = 0; q < 4; ++q)
      for (std::size_t r = 0; r < 6; ++r)  // rounded to 2^-15
        EXPECT_NEAR(costs.at(q, r), shifted_cosine(a, q, b, r, columns), 2e-5);
  }
}

TEST(DescriptorCosts, OfPixelsAreTheAbsoluteDifference) {
  for (const int width : {64, 128, 8}) {
    const vo::ImageStack a = test_support::random_images(width, 4, 3, 1),
                         b = test_support::random_images(width, 4, 5, 2);
    EXPECT_EQ(cost_matrix(*descriptor_costs(a, b, {.columns = width})).values,
              place::cost_matrix(a, b).values);
    // An eighth of the picture, however wide it is.
    EXPECT_EQ(cost_matrix(*descriptor_costs(a, b, {.columns = width}, 8)).values,
              place::cost_matrix(a, b, {.max_shift_px = width / 8}).values);
  }
}

TEST(DescriptorCosts, RefuseFormsThatDiffer) {
  EXPECT_THROW(descriptor_costs(FloatRows{}, ColumnStack{}, {}), std::invalid_argument);
  EXPECT_THROW(descriptor_costs(random_columns(2, 3, 1, 1), random_columns(3, 2, 1, 1), {.columns = 2}),
               std::invalid_argument);
}

TEST(CandidatesOfDescriptors, HoldWhereAWalkOfColumnsIs) {
  const ColumnStack reference = random_columns(8, 32, 3000, 3);
  ColumnStack query = place::make_column_stack(8, 32, 100);
  std::copy_n(reference[1500].data(), query.values.size(), query.values.begin());
  const std::vector<std::size_t> found = place::candidates(Descriptors(query), Descriptors(reference));
  EXPECT_LT(found.size(), 3000U);
  for (std::size_t i = 1500; i < 1600; ++i) EXPECT_THAT(found, testing::Contains(i));
}

TEST(CandidatesOfDescriptors, AreAllOfRowsOfFloats) {
  const FloatRows rows{.width = 1, .values = {1, 2, 3}};
  EXPECT_THAT(place::candidates(Descriptors(rows), Descriptors(rows)), testing::ElementsAre(0, 1, 2));
  EXPECT_THROW(place::candidates(Descriptors(rows), Descriptors(ColumnStack{})), std::invalid_argument);
}

}  // namespace
