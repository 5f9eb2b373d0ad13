#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/float_costs.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::FloatRows;
using place::Metric;
using testing::Each;

constexpr Metric kMetrics[] = {Metric::kCosine, Metric::kL1, Metric::kL2};

FloatRows random_rows(std::size_t width, std::size_t count, std::uint64_t seed) {
  FloatRows rows = place::make_float_rows(width, count);
  vo::Rng rng(seed);
  for (float& value : rows.values) value = static_cast<float>(rng.normal());
  return rows;
}

double defined_cost(std::span<const float> a, std::span<const float> b, Metric metric) {
  double dot = 0, aa = 0, bb = 0, l1 = 0, l2 = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double x = a[k], y = b[k];
    dot += x * y, aa += x * x, bb += y * y, l1 += std::abs(x - y), l2 += (x - y) * (x - y);
  }
  if (metric == Metric::kL1) return l1 / static_cast<double>(a.size());
  return metric == Metric::kL2 ? std::sqrt(l2) : 1 - dot / std::sqrt(aa * bb);
}

TEST(FloatCosts, WorkedExample) {
  const FloatRows query{.width = 2, .values = {3, 4}};
  const FloatRows references{.width = 2, .values = {3, 4, -3, -4, 6, 8, 4, -3}};
  const auto costs = [&](Metric metric) {
    return cost_matrix(place::FloatCosts(query, references, metric)).values;
  };
  // Exact in units of 2^-15 and, as no row is longer than 10, in those of a power of two below 1.
  EXPECT_THAT(costs(Metric::kCosine), testing::ElementsAre(0, 2, 0, 1));
  EXPECT_THAT(costs(Metric::kL1), testing::ElementsAre(0, 7, 3.5F, 4));
  EXPECT_THAT(costs(Metric::kL2),
              testing::Pointwise(testing::FloatNear(1e-3F), {0.0F, 10.0F, 5.0F, std::sqrt(50.0F)}));
}

TEST(FloatCosts, EqualTheDefinitionUpToRounding) {
  for (const std::size_t width : {1, 3, 64, 700}) {
    const FloatRows queries = random_rows(width, 29, 1), references = random_rows(width, 75, 2);
    for (const Metric metric : kMetrics) {
      const place::FloatCosts source(queries, references, metric);
      const auto matrix = cost_matrix(source);
      double largest = 0;
      for (std::size_t q = 0; q < 29; ++q) {
        for (std::size_t r = 0; r < 75; ++r) {
          // Half a unit, and as many roundings of a float as there are values, of costs of a few at most.
          const double expected = defined_cost(queries[q], references[r], metric);
          const double tolerance =
              0.5 * source.unit() + 1e-7 * static_cast<double>(width) * std::max(1.0, expected);
          ASSERT_NEAR(matrix.at(q, r), expected, tolerance) << width;
          ASSERT_EQ(std::round(matrix.at(q, r) / source.unit()) * source.unit(), matrix.at(q, r));
          largest = std::max(largest, static_cast<double>(matrix.at(q, r)));
        }
      }
      EXPECT_LE(largest / source.unit(), 1 << 16);  // a cache of 16 bits holds them
    }
  }
}

TEST(FloatCosts, GiveBlocksOfTheMatrixForAnyThreadCount) {
  const FloatRows queries = random_rows(40, 53, 1), references = random_rows(40, 150, 2);
  for (const Metric metric : kMetrics) {
    const place::FloatCosts source(queries, references, metric);
    const auto matrix = cost_matrix(source);
    for (const int threads : {1, 4}) {
      vo::set_thread_count(threads);
      std::vector<float> some(20 * 100, -1);
      const place::Costs block{7, 20, 33, 90, some.data(), 100};
      source.compute(block);
      for (std::size_t i = 0; i < 20; ++i) {
        EXPECT_TRUE(std::ranges::equal(block.row(i), matrix.row(7 + i).subspan(33, 90)));
        EXPECT_THAT(std::span(some).subspan(i * 100 + 90, 10), Each(-1));
      }
    }
  }
  vo::set_thread_count(0);
}

TEST(FloatCosts, OfNothingAndOfZeros) {
  const FloatRows none = random_rows(4, 0, 1), some = random_rows(4, 3, 1),
                  zeros = place::make_float_rows(4, 2);
  for (const Metric metric : kMetrics) {
    EXPECT_TRUE(cost_matrix(place::FloatCosts(none, some, metric)).values.empty());
    EXPECT_TRUE(cost_matrix(place::FloatCosts(some, none, metric)).values.empty());
    const float expected = metric == Metric::kCosine ? 1 : 0;
    EXPECT_THAT(cost_matrix(place::FloatCosts(zeros, zeros, metric)).values, Each(expected));
  }
  EXPECT_THAT(cost_matrix(place::FloatCosts(zeros, some, Metric::kCosine)).values, Each(1.0F));
}

TEST(FloatCosts, RefuseWhatTheyCannotCompare) {
  const FloatRows rows = random_rows(4, 3, 1);
  EXPECT_THROW(place::FloatCosts(rows, random_rows(5, 3, 1), Metric::kL2), std::invalid_argument);
  for (const float wrong :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e20F}) {
    FloatRows other = rows;
    other.values[6] = wrong;
    EXPECT_THROW(place::FloatCosts(rows, other, Metric::kCosine), std::invalid_argument) << wrong;
  }
}

}  // namespace
