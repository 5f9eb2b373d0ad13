#include "match/cone_shape.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace {

using place::ConeShape;
using place::SequenceSearchOptions;

TEST(ConeShape, LiesBetweenTheSlowestAndTheFastestLine) {
  // Speeds 0.5 and 1.5, queries -2 .. 1 from the pair: offsets -1 and -3, -1 (rounded from -0.5) and -2
  // (-1.5) away from 0, then 1 (0.5) and 2 (1.5).
  const ConeShape shape({.length = 4, .v_min = 0.5, .v_max = 1.5}, 10, 10);
  ASSERT_EQ(shape.rows().size(), 4U);
  const std::vector<std::array<std::ptrdiff_t, 3>> expected{{-2, -3, -1}, {-1, -2, -1}, {0, 0, 0}, {1, 1, 2}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(shape.rows()[k].along, expected[k][0]) << k;
    EXPECT_EQ(shape.rows()[k].low, expected[k][1]) << k;
    EXPECT_EQ(shape.rows()[k].high, expected[k][2]) << k;
  }
}

TEST(ConeShape, CountsTheRowsThatTouchTheMatrix) {
  const SequenceSearchOptions options{.length = 6, .search_range_rad = 0.5};
  const std::size_t queries = 9, references = 12;
  const ConeShape shape(options, queries, references);
  for (std::size_t q = 0; q < queries; ++q) {
    for (std::size_t r = 0; r < references; ++r) {
      int terms = 0;
      for (const ConeShape::Row& row : shape.rows()) {
        const auto at = static_cast<std::ptrdiff_t>(q) + row.along;
        bool touches = false;
        for (std::ptrdiff_t d = row.low; d <= row.high; ++d) {
          const auto other = static_cast<std::ptrdiff_t>(r) + d;
          touches = touches || (other >= 0 && other < static_cast<std::ptrdiff_t>(references));
        }
        terms += static_cast<int>(touches && at >= 0 && at < static_cast<std::ptrdiff_t>(queries));
      }
      EXPECT_EQ(shape.terms(q, r), terms) << q << ' ' << r;
    }
  }
}

TEST(ConeShape, AsksForThePartOfASequenceThatLinesAskFor) {
  const ConeShape shape({.length = 5, .min_fraction = 0.5}, 10, 10);
  EXPECT_FALSE(shape.enough(2));
  EXPECT_TRUE(shape.enough(3));
  EXPECT_EQ(shape.factor(5), 0.2F);
}

TEST(ConeShape, RefusesOptionsThatAreNotValid) {
  EXPECT_THROW(ConeShape({.length = 0}, 3, 3), std::invalid_argument);
}

}  // namespace
