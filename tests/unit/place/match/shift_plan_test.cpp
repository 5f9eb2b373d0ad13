#include "match/shift_plan.hpp"

#include "support/random_columns.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using test_support::random_columns;
using testing::ElementsAre;

/// Products of column j + s of the one with column j of the other.
int overlap_sum(const place::ColumnStack& query, const place::ColumnStack& reference, int shift) {
  int sum = 0;
  for (int j = std::max(0, -shift); j < query.columns - std::max(0, shift); ++j) {
    for (int k = 0; k < query.channels; ++k) {
      sum += query[0][static_cast<std::size_t>((j + shift) * query.channels + k)] *
             reference[0][static_cast<std::size_t>(j * query.channels + k)];
    }
  }
  return sum;
}

/// The dot products that a plan asks for, of spread descriptors of two channels more.
std::vector<int> products(const place::ShiftPlan& plan, const place::ColumnStack& query,
                          const place::ColumnStack& reference) {
  const std::size_t channels = static_cast<std::size_t>(query.channels) + 2;
  std::vector<std::int8_t> left(plan.query_columns * channels, 99),
      right(plan.reference_columns * channels, 99);
  place::spread_query(plan, query[0], channels, left);
  place::spread_reference(plan, reference[0], channels, right);
  std::vector<int> sums;
  for (const auto& stretch : plan.stretches) {
    int sum = 0;
    for (std::size_t k = 0; k < stretch.length * channels; ++k)
      sum += left.at(stretch.query * channels + k) * right.at(stretch.reference * channels + k);
    sums.push_back(sum);
  }
  return sums;
}

TEST(ShiftPlan, DirectlyIsAStretchForEachShift) {
  const place::ColumnStack query{.columns = 3, .channels = 1, .values = {1, 2, 3}};
  const place::ColumnStack reference{.columns = 3, .channels = 1, .values = {10, 20, 30}};
  // s = -1: 1 * 20 + 2 * 30; 0: 10 + 40 + 90; 1: 2 * 10 + 3 * 20.
  EXPECT_THAT(products(place::direct_plan(3, 1), query, reference), ElementsAre(80, 140, 80));
  EXPECT_THAT(products(place::direct_plan(3, 0), query, reference), ElementsAre(140));
  for (int columns = 1; columns < 7; ++columns) {
    for (int most = 0; most < columns; ++most) {
      const auto a = random_columns(columns, 5, 1, 127, 1), b = random_columns(columns, 5, 1, 127, 2);
      std::vector<int> expected;
      for (int shift = -most; shift <= most; ++shift) expected.push_back(overlap_sum(a, b, shift));
      EXPECT_EQ(
          products(place::direct_plan(static_cast<std::size_t>(columns), static_cast<std::size_t>(most)), a,
                   b),
          expected);
    }
  }
}

TEST(ShiftPlan, FastGivesTheFiveShiftsByItsIdentities) {
  for (int columns = 3; columns <= 21; ++columns) {
    for (const int most : {1, place::kFastLimit}) {
      const auto a = random_columns(columns, 7, 1, most, 3), b = random_columns(columns, 7, 1, most, 4);
      const auto ten = products(place::fast_plan(static_cast<std::size_t>(columns)), a, b);
      ASSERT_EQ(ten.size(), 10U);
      const auto lags = [&](std::size_t first) {
        const int middle = (ten[first + 1] + ten[first + 2]) / 2;
        return std::vector<int>{ten[first] + middle, (ten[first + 1] - ten[first + 2]) / 2,
                                middle - ten[first + 3]};
      };
      const auto even = lags(0), odd = lags(4);
      EXPECT_EQ(even[0] + odd[0], overlap_sum(a, b, -2)) << columns;
      EXPECT_EQ(ten[8] - odd[0] - even[1], overlap_sum(a, b, -1)) << columns;
      EXPECT_EQ(even[1] + odd[1], overlap_sum(a, b, 0)) << columns;
      EXPECT_EQ(ten[9] - odd[1] - even[2], overlap_sum(a, b, 1)) << columns;
      EXPECT_EQ(even[2] + odd[2], overlap_sum(a, b, 2)) << columns;
    }
  }
}

/// What is spread stays within a byte, and -128 is not reached: the sums would be wrong above otherwise, but
/// random values need not show it.
TEST(ShiftPlan, FastStaysWithinAByte) {
  for (const int sign : {1, -1}) {
    place::ColumnStack extreme{.columns = 8, .channels = 1, .values = {}};
    for (int j = 0; j < 8; ++j)
      extreme.values.push_back(static_cast<std::int8_t>(j % 4 < 2 ? 63 : sign * 63));
    const auto plan = place::fast_plan(8);
    std::vector<std::int8_t> left(plan.query_columns), right(plan.reference_columns);
    place::spread_query(plan, extreme[0], 1, left);
    place::spread_reference(plan, extreme[0], 1, right);
    for (const auto& row : {left, right}) {
      EXPECT_TRUE(std::ranges::all_of(row, [](int value) { return std::abs(value) <= 126; }));
      EXPECT_TRUE(std::ranges::any_of(row, [](int value) { return std::abs(value) == 126; }));
    }
  }
}

TEST(ShiftPlan, FastTakes24ProductsForEightColumns) {
  std::size_t sum = 0;
  for (const auto& stretch : place::fast_plan(8).stretches) sum += stretch.length;
  EXPECT_EQ(sum, 24U);
  sum = 0;
  for (const auto& stretch : place::direct_plan(8, 2).stretches) sum += stretch.length;
  EXPECT_EQ(sum, 34U);
}

}  // namespace
