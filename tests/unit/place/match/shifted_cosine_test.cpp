#include "support/random_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/shifted_cosine.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::ColumnStack;
using test_support::random_columns;
using testing::Each;

constexpr float kUnits = 32768;

/// The cost by its definition, a step of rounding at a time.
float defined_cost(std::span<const std::int8_t> query, std::span<const std::int8_t> reference, int columns,
                   int most) {
  const int channels = static_cast<int>(query.size()) / columns;
  float largest = -2;
  for (int shift = -most; shift <= most; ++shift) {
    long dot = 0, of_query = 0, of_reference = 0;
    for (int j = std::max(0, -shift); j < columns - std::max(0, shift); ++j) {
      for (int k = 0; k < channels; ++k) {
        const int q = query[static_cast<std::size_t>((j + shift) * channels + k)];
        const int r = reference[static_cast<std::size_t>(j * channels + k)];
        dot += q * r;
        of_query += q * q;
        of_reference += r * r;
      }
    }
    const double share = static_cast<double>(columns - std::abs(shift)) / columns;
    const float g = of_query == 0 ? 0 : static_cast<float>(std::sqrt(share / static_cast<double>(of_query)));
    const float f =
        of_reference == 0 ? 0 : static_cast<float>(std::sqrt(1 / static_cast<double>(of_reference)));
    const float scaled = static_cast<float>(dot) * f;
    largest = std::max(largest, scaled * g);
  }
  return std::nearbyint(kUnits - largest * kUnits) / kUnits;
}

TEST(ShiftedCosine, WorkedExample) {
  // Two columns of one channel. Query (3, 4), references (3, 4), (-3, -4), (4, 3), (4, 0).
  const ColumnStack query{.columns = 2, .channels = 1, .values = {3, 4}};
  const ColumnStack references{.columns = 2, .channels = 1, .values = {3, 4, -3, -4, 4, 3, 4, 0}};
  const auto as_it_is = cost_matrix(place::ShiftedCosine(query, references, {.max_shift_columns = 0}));
  // Cosines 1, -1, 24/25 and 3/5; half a unit of the rounding.
  EXPECT_THAT(as_it_is.values,
              testing::Pointwise(testing::FloatNear(0.5F / kUnits), {0.0F, 2.0F, 0.04F, 0.4F}));
  // A shift of one: the cosine of one value with another, 1 or -1 or 0, times sqrt(1/2).
  const auto shifted = cost_matrix(place::ShiftedCosine(query, references, {.max_shift_columns = 1}));
  const float aside = 1 - std::sqrt(0.5F);
  EXPECT_THAT(shifted.values, testing::Pointwise(testing::FloatNear(0.5F / kUnits),
                                                 {0.0F, 1 + std::sqrt(0.5F), 0.04F, aside}));
}

TEST(ShiftedCosine, EqualsItsDefinitionToTheBit) {
  struct Case {
    int columns, channels, shift;
  };
  for (const int most : {127, 63}) {  // the latter by the fast plan, where the shift is 2
    for (const Case& c : {Case{8, 128, 2},
                          {8, 12, 0},
                          {8, 5, 1},
                          {4, 8, 2},
                          {7, 16, 2},
                          {20, 31, 5},
                          {1, 10, 0},
                          {3, 1, 2}}) {
      const auto queries = random_columns(c.columns, c.channels, 27, most, 1);
      const auto references = random_columns(c.columns, c.channels, 75, most, 2);
      const auto matrix =
          cost_matrix(place::ShiftedCosine(queries, references, {.max_shift_columns = c.shift}));
      for (std::size_t q = 0; q < 27; ++q) {
        for (std::size_t r = 0; r < 75; ++r) {
          ASSERT_EQ(matrix.at(q, r), defined_cost(queries[q], references[r], c.columns, c.shift))
              << c.columns << ' ' << c.channels << ' ' << c.shift << ' ' << most;
        }
      }
    }
  }
}

TEST(ShiftedCosine, OfAViewTurnedByColumnsIsThatOfTheOverlap) {
  // Ten columns of which the walks see eight, two further on.
  const auto wide = random_columns(10, 16, 1, 60, 3);
  const ColumnStack here{8, 16, {wide.values.begin(), wide.values.end() - 2 * 16}};
  const ColumnStack there{8, 16, {wide.values.begin() + 2 * 16, wide.values.end()}};
  for (const auto& [a, b] : {std::pair{here, there}, {there, here}}) {
    EXPECT_GT(cost_matrix(place::ShiftedCosine(a, b, {.max_shift_columns = 1})).values[0], 0.5F);
    for (const int most : {2, 3}) {
      // The overlap is the same to the bit: cosine 1, weighted by sqrt(6 / 8). Two roundings to float.
      EXPECT_NEAR(cost_matrix(place::ShiftedCosine(a, b, {.max_shift_columns = most})).values[0],
                  1 - std::sqrt(0.75), 1 / kUnits);
    }
  }
}

TEST(ShiftedCosine, IsZeroWithItselfAndOneWithNothing) {
  auto walk = random_columns(8, 16, 40, 63, 4);
  std::fill_n(walk.values.begin(), walk.descriptor_size(), std::int8_t{0});
  const auto matrix = cost_matrix(place::ShiftedCosine(walk, walk));
  EXPECT_THAT(matrix.row(0), Each(1.0F));
  for (std::size_t i = 1; i < 40; ++i) {
    EXPECT_EQ(matrix.at(i, 0), 1);
    EXPECT_EQ(matrix.at(i, i), 0);
    for (std::size_t j = 1; j < i; ++j) EXPECT_GT(matrix.at(i, j), 0);
  }
}

TEST(ShiftedCosine, DoesNotDependOnTheStrengthOfADescriptor) {
  auto weak = random_columns(8, 16, 10, 40, 5);
  auto strong = weak;
  for (std::int8_t& value : strong.values) value = static_cast<std::int8_t>(3 * value);
  const auto walk = random_columns(8, 16, 30, 60, 6);
  const auto a = cost_matrix(place::ShiftedCosine(weak, walk)),
             b = cost_matrix(place::ShiftedCosine(strong, walk));
  // Also not on the plan: 120 is beyond what the fast one takes. A float rounding of each side may move a
  // cost to the next unit.
  for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1 / kUnits);
}

TEST(ShiftedCosine, GivesBlocksOfTheMatrixForAnyThreadCount) {
  const auto queries = random_columns(8, 12, 53, 63, 1), references = random_columns(8, 12, 300, 63, 2);
  const place::ShiftedCosine source(queries, references);
  const auto matrix = cost_matrix(source);
  for (const int threads : {1, 4}) {
    vo::set_thread_count(threads);
    for (std::size_t q = 0; q < 53; q += 17) {
      for (std::size_t r = 0; r < 300; r += 130) {
        const std::size_t tall = std::min<std::size_t>(17, 53 - q),
                          wide = std::min<std::size_t>(130, 300 - r);
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
  }
  vo::set_thread_count(0);
  for (const float cost : matrix.values) EXPECT_EQ(std::round(cost / source.unit()) * source.unit(), cost);
}

TEST(ShiftedCosine, OfEmptyStacksIsEmpty) {
  const auto none = random_columns(4, 4, 0, 9, 1), some = random_columns(4, 4, 3, 9, 1);
  EXPECT_EQ(cost_matrix(place::ShiftedCosine(none, some)).references, 3U);
  EXPECT_EQ(cost_matrix(place::ShiftedCosine(some, none)).queries, 3U);
  EXPECT_TRUE(cost_matrix(place::ShiftedCosine(none, none)).values.empty());
}

TEST(ShiftedCosine, RefusesWhatItCannotCompare) {
  const auto columns = random_columns(4, 4, 2, 9, 1);
  EXPECT_NO_THROW(place::ShiftedCosine(columns, columns, {.max_shift_columns = 3}));
  EXPECT_THROW(place::ShiftedCosine(columns, columns, {.max_shift_columns = 4}), std::invalid_argument);
  EXPECT_THROW(place::ShiftedCosine(columns, columns, {.max_shift_columns = -1}), std::invalid_argument);
  EXPECT_THROW(place::ShiftedCosine(columns, random_columns(4, 5, 2, 9, 1)), std::invalid_argument);
  EXPECT_THROW(place::ShiftedCosine(columns, random_columns(5, 4, 2, 9, 1)), std::invalid_argument);
  auto lowest = columns;
  lowest.values[5] = -128;
  EXPECT_THROW(place::ShiftedCosine(columns, lowest), std::invalid_argument);
  const auto huge = random_columns(3, 50'000, 1, 9, 1);
  EXPECT_THROW(place::ShiftedCosine(huge, huge), std::invalid_argument);
}

}  // namespace
