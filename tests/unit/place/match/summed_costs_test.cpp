#include "place/match/summed_costs.hpp"

#include <memory>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/float_costs.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::CostMatrix;
using place::FloatCosts;
using place::FloatRows;
using place::SummedCosts;
using place::SummedPart;

FloatRows random_rows(std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  FloatRows rows = place::make_float_rows(4, count);
  for (float& value : rows.values) value = static_cast<float>(rng.uniform(-1, 1));
  return rows;
}

class SummedCostsTest : public testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<place::CostSource> part(int i) const {
    return i == 0 ? std::make_unique<FloatCosts>(query_a_, reference_a_, place::Metric::kCosine)
                  : std::make_unique<FloatCosts>(query_b_, reference_b_, place::Metric::kL2);
  }
  [[nodiscard]] SummedCosts both() const {
    std::vector<SummedPart> parts;
    parts.push_back({part(0), 30});
    parts.push_back({part(1), 0});
    return SummedCosts(std::move(parts));
  }
  // More references than a part of the survey has.
  FloatRows query_a_ = random_rows(9, 1), reference_a_ = random_rows(4500, 2), query_b_ = random_rows(9, 3),
            reference_b_ = random_rows(4500, 4);
};

TEST_F(SummedCostsTest, AreTheSumOfStandardisedMatrices) {
  CostMatrix a = cost_matrix(*part(0)), b = cost_matrix(*part(1));
  place::enhance_contrast(a, {.prior_queries = 30});
  place::enhance_contrast(b, {});
  const CostMatrix sum = cost_matrix(both());
  ASSERT_EQ(sum.values.size(), a.values.size());
  // Moved by one number for all, rounded to 1/1024.
  const float moved = sum.values[0] - (a.values[0] + b.values[0]);
  for (std::size_t i = 0; i < sum.values.size(); ++i) {
    EXPECT_NEAR(sum.values[i] - (a.values[i] + b.values[i]), moved, 1.1 / 1024);
    EXPECT_GE(sum.values[i], 0);
  }
}

TEST_F(SummedCostsTest, AreTheSameInBlocks) {
  const SummedCosts costs = both();
  const CostMatrix whole = cost_matrix(costs);
  std::vector<float> values(4 * 50);
  costs.compute({3, 4, 1007, 50, values.data(), 50});
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t r = 0; r < 50; ++r) EXPECT_EQ(values[q * 50 + r], whole.at(3 + q, 1007 + r));
}

TEST_F(SummedCostsTest, RefuseNoPartsAndPartsOfDifferentSize) {
  EXPECT_THROW(SummedCosts({}), std::invalid_argument);
  std::vector<SummedPart> parts;
  parts.push_back({part(0), 0});
  parts.push_back({std::make_unique<FloatCosts>(query_a_, query_a_, place::Metric::kL1), 0});
  EXPECT_THROW(SummedCosts(std::move(parts)), std::invalid_argument);
}

}  // namespace
