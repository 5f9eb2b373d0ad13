#include "match/row_minimum.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(RowMinimum, IsTheFirstOfTheLeast) {
  const std::vector<float> row{3, -1, 2, -1};
  EXPECT_EQ(place::row_minimum(row).reference, 1U);
  EXPECT_EQ(place::row_minimum(row).cost, -1);
}

TEST(RowMinimum, IsTheRowsSizeWhereNothingIsFinite) {
  EXPECT_EQ(place::row_minimum({}).reference, 0U);
  EXPECT_EQ(place::row_minimum({}).cost, kInfinity);
  const std::vector<float> row(5, kInfinity);
  EXPECT_EQ(place::row_minimum(row).reference, 5U);
}

TEST(RowMinimum, EqualsAPlainLoopForRowsOfAnyLength) {
  vo::Rng rng(1);
  for (std::size_t size = 1; size < 70; ++size) {
    std::vector<float> row(size);
    for (float& value : row) value = static_cast<float>(rng.index(40));  // some are equal
    const auto least = std::min_element(row.begin(), row.end());
    EXPECT_EQ(place::row_minimum(row).cost, *least) << size;
    EXPECT_EQ(place::row_minimum(row).reference, static_cast<std::size_t>(least - row.begin())) << size;
  }
}

TEST(MinimumOutside, LeavesTheWindowOut) {
  const std::vector<float> row{5, 4, 0, 1, 2, 7, 3};
  EXPECT_EQ(place::minimum_outside(row, 2, 0), 1);
  EXPECT_EQ(place::minimum_outside(row, 2, 2), 3);
  EXPECT_EQ(place::minimum_outside(row, 0, 1), 0);
  EXPECT_EQ(place::minimum_outside(row, 6, 4), 4);
}

TEST(MinimumOutside, IsInfiniteWhereTheWindowIsTheRow) {
  EXPECT_EQ(place::minimum_outside(std::vector<float>{1}, 0, 0), kInfinity);
  EXPECT_EQ(place::minimum_outside(std::vector<float>{1, 2, 3}, 1, 10), kInfinity);
}

}  // namespace
