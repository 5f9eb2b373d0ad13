#include "kernels/interleave.hpp"

#include <numeric>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using place::FloatRows;
using testing::ElementsAre;

FloatRows counting(std::size_t width, std::size_t count) {
  FloatRows rows = place::make_float_rows(width, count);
  std::iota(rows.values.begin(), rows.values.end(), 1.0F);
  return rows;
}

TEST(Interleave, PutsValuesOfRowsSideBySideAndFillsWithZeros) {
  std::vector<float> to(3 * 2, -1);
  place::kernels::interleave(counting(4, 3), {.first = 1, .count = 2, .from = 2, .values = 2}, 3, to.data());
  EXPECT_THAT(to, ElementsAre(7, 11, 0, 8, 12, 0));
}

TEST(Interleave, OfLongRowsReachesEveryValue) {
  const FloatRows rows = counting(37, 2);
  std::vector<float> to(2 * 37, -1);
  place::kernels::interleave(rows, {.first = 0, .count = 2, .from = 0, .values = 37}, 2, to.data());
  for (std::size_t k = 0; k < 37; ++k)
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(to[2 * k + i], rows[i][k]);
}

TEST(Interleave, OfColumnsTakesThemForRows) {
  std::vector<float> to(3 * 2, -1);
  place::kernels::interleave_columns(counting(4, 3), {.first = 2, .count = 2, .from = 1, .values = 2}, 3,
                                     to.data());
  EXPECT_THAT(to, ElementsAre(7, 8, 0, 11, 12, 0));
}

}  // namespace
