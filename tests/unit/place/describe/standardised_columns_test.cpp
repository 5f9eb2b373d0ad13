#include "describe/standardised_columns.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/describe/quantise.hpp>
#include <vo/base/error.hpp>

namespace {

using place::ColumnStack;
using place::FloatRows;
using place::pack_spread;
using place::spread_of;
using place::standardised_columns;

TEST(StandardisedColumns, AreStandardScoresInBytes) {
  // One value 1 and 3: mean 2, deviation 1, by a tenth more; the learned spread is the same.
  const FloatRows rows{.width = 2, .values = {1, 5, 3, 5}};
  const ColumnStack stack = standardised_columns(rows, pack_spread(spread_of(rows)), 2);
  EXPECT_EQ(stack.columns, 2);
  EXPECT_EQ(stack.channels, 1);
  // Deviations 1 and 0 are raised by a tenth of their mean, 0.05; four of them are the largest byte.
  const auto byte = static_cast<int>(std::lround(1 / 1.05 * place::kLargestByte / 4));
  EXPECT_THAT(stack.values, testing::ElementsAre(-byte, 0, byte, 0));
}

TEST(StandardisedColumns, OfNoRowsAreNone) {
  const FloatRows rows{.width = 2, .values = {1, 2}};
  EXPECT_EQ(standardised_columns({.width = 2, .values = {}}, pack_spread(spread_of(rows)), 1).size(), 0U);
}

TEST(StandardisedColumns, RefuseASpreadOfAnotherSize) {
  const FloatRows rows{.width = 2, .values = {1, 2}};
  EXPECT_THROW(standardised_columns({.width = 1, .values = {1}}, pack_spread(spread_of(rows)), 1), vo::Error);
  EXPECT_THROW(standardised_columns(rows, place::Bytes(3), 1), vo::Error);
}

}  // namespace
