#include "place/describe/standardise.hpp"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using place::FloatRows;
using place::Spread;
using place::spread_of;
using place::standardise;

TEST(SpreadOf, OfTwoRows) {
  const Spread spread = spread_of({.width = 2, .values = {1, 5, 3, 5}});
  EXPECT_THAT(spread.mean.values, testing::ElementsAre(2, 5));
  EXPECT_THAT(spread.deviation.values, testing::ElementsAre(1, 0));
  EXPECT_THROW(spread_of({}), std::invalid_argument);
}

TEST(Standardise, MixesItsOwnSpreadWithTheLearned) {
  // Two rows of mean 2 and deviation 1, learned mean 0 and deviation 4: w = 2 / 102.
  FloatRows rows{.width = 1, .values = {1, 3}};
  standardise(rows, {{.width = 1, .values = {0}}, {.width = 1, .values = {4}}});
  const double w = 2.0 / 102, mean = w * 2, deviation = w * 1 + (1 - w) * 4;
  EXPECT_NEAR(rows.values[0], (1 - mean) / (1.1 * deviation), 1e-6);
  EXPECT_NEAR(rows.values[1], (3 - mean) / (1.1 * deviation), 1e-6);
}

TEST(Standardise, ByItsOwnSpreadAloneGivesMeanZero) {
  FloatRows rows{.width = 2, .values = {1, 7, 2, 7, 6, 10}};
  const Spread own = spread_of(rows);
  standardise(rows, own);
  for (const std::size_t k : {0U, 1U})
    EXPECT_NEAR(rows.values[k] + rows.values[2 + k] + rows.values[4 + k], 0, 1e-5);  // float sums
}

TEST(Standardise, OfConstantRowsIsNothing) {
  FloatRows rows{.width = 2, .values = {4, 5, 4, 5}};
  standardise(rows, spread_of(rows));
  EXPECT_THAT(rows.values, testing::Each(0.0F));
}

TEST(Standardise, OfNoRowsIsNone) {
  FloatRows rows{.width = 1, .values = {}};
  standardise(rows, {{.width = 1, .values = {0}}, {.width = 1, .values = {1}}});
  EXPECT_TRUE(rows.values.empty());
  EXPECT_THROW(standardise(rows, {}), std::invalid_argument);
}

}  // namespace
