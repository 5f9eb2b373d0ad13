#include "place/match/float_costs.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using place::cost_matrix;
using place::FloatCosts;
using place::FloatRows;
using place::Metric;

TEST(FloatCosts, WorkedExample) {
  const FloatRows queries{.width = 2, .values = {3, 4, 0, 0}}, references{.width = 2, .values = {4, 3, 3, 4}};
  const auto costs = [&](Metric metric) {
    return cost_matrix(FloatCosts(queries, references, metric)).values;
  };
  // Rounded to 2^-15 (the cosine is at most 2 of them away from 0), 2^-13 and 2^-12.
  EXPECT_THAT(costs(Metric::kCosine),
              testing::Pointwise(testing::FloatNear(2e-5F), std::vector<float>{0.04F, 0, 1, 1}));
  EXPECT_THAT(costs(Metric::kL1),
              testing::Pointwise(testing::FloatNear(1e-4F), std::vector<float>{1, 0, 3.5F, 3.5F}));
  EXPECT_THAT(costs(Metric::kL2),
              testing::Pointwise(testing::FloatNear(2e-4F), std::vector<float>{std::sqrt(2.0F), 0, 5, 5}));
}

TEST(FloatCosts, AreWholeMultiplesOfTheirUnitAndTheSameInBlocks) {
  vo::Rng rng(5);
  FloatRows queries = place::make_float_rows(19, 5), references = place::make_float_rows(19, 7);
  for (FloatRows* rows : {&queries, &references})
    for (float& value : rows->values) value = static_cast<float>(rng.uniform(-20, 20));
  for (const Metric metric : {Metric::kCosine, Metric::kL1, Metric::kL2}) {
    const FloatCosts source(queries, references, metric);
    const place::CostMatrix whole = cost_matrix(source);
    for (const float cost : whole.values) {
      EXPECT_EQ(cost / source.unit(), std::nearbyint(cost / source.unit()));
      EXPECT_LE(cost / source.unit(), 65536);
    }
    std::vector<float> values(2 * 3);
    source.compute({3, 2, 4, 3, values.data(), 3});
    for (std::size_t q = 0; q < 2; ++q)
      for (std::size_t r = 0; r < 3; ++r) EXPECT_EQ(values[q * 3 + r], whole.at(3 + q, 4 + r));
  }
}

TEST(FloatCosts, OfNothingAreNone) {
  const FloatRows none{.width = 3, .values = {}}, one{.width = 3, .values = {1, 2, 3}};
  EXPECT_TRUE(cost_matrix(FloatCosts(none, one, Metric::kL2)).values.empty());
  EXPECT_EQ(cost_matrix(FloatCosts(one, one, Metric::kL1)).values[0], 0);
  EXPECT_THROW(FloatCosts(one, {.width = 1, .values = {1}}, Metric::kL1), std::invalid_argument);
}

}  // namespace
