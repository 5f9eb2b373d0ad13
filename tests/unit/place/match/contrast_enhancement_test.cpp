#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/contrast_enhancement.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::Enhancement;
using testing::Each;
using testing::ElementsAre;

place::CostMatrix random_costs(std::size_t queries, std::size_t references, std::uint64_t seed) {
  vo::Rng rng(seed);
  place::CostMatrix costs = place::make_cost_matrix(queries, references);
  for (float& value : costs.values) value = static_cast<float>(rng.uniform(0.2, 1.4));
  return costs;
}

place::CostMatrix enhanced(place::CostMatrix costs, Enhancement method, int window = 10) {
  place::enhance_contrast(costs, {.method = method, .window = window});
  return costs;
}

/// (value - mean) / deviation in two passes, with `freedom` taken off the count in the variance.
double standard_score(double value, const std::vector<double>& among, double freedom) {
  const auto count = static_cast<double>(among.size());
  double mean = 0, spread = 0;
  for (const double v : among) mean += v / count;
  for (const double v : among) spread += (v - mean) * (v - mean);
  return (value - mean) / std::sqrt(spread / (count - freedom));
}

/// The difference allowed to a reference in double: float inputs and results of up to about 5 have 24 bits;
/// the one-pass variance loses a few more.
constexpr double kFloatRounding = 1e-5;

TEST(EnhanceLocal, WorkedExample) {
  // Window 2: one neighbour on either side. {1, 3}: mean 2, sample deviation sqrt(2). {1, 3, 8}: mean 4,
  // squares 9 + 1 + 16 over 2. {3, 8}: mean 5.5, deviation sqrt(12.5).
  place::CostMatrix costs{.queries = 1, .references = 3, .values = {1, 3, 8}};
  place::enhance_contrast(costs, {.method = Enhancement::kLocal, .window = 2});
  EXPECT_FLOAT_EQ(costs.values[0], static_cast<float>(-1 / std::sqrt(2.0)));
  EXPECT_FLOAT_EQ(costs.values[1], static_cast<float>(-1 / std::sqrt(13.0)));
  EXPECT_FLOAT_EQ(costs.values[2], static_cast<float>(2.5 / std::sqrt(12.5)));
}

TEST(EnhanceLocal, EqualsTheDefinition) {
  for (const int window : {2, 3, 10, 1000}) {
    SCOPED_TRACE(window);
    const auto costs = random_costs(3, 40, 1);
    const auto result = enhanced(costs, Enhancement::kLocal, window);
    for (std::size_t q = 0; q < 3; ++q) {
      for (int r = 0; r < 40; ++r) {
        std::vector<double> among;
        for (int other = std::max(0, r - window / 2); other <= std::min(39, r + window / 2); ++other)
          among.push_back(costs.at(q, static_cast<std::size_t>(other)));
        const auto at = static_cast<std::size_t>(r);
        EXPECT_NEAR(result.at(q, at), standard_score(costs.at(q, at), among, 1), kFloatRounding);
      }
    }
  }
}

TEST(EnhanceStandardise, EqualsTheDefinition) {
  // More references than a thread takes at a time.
  constexpr std::size_t kQueries = 9, kReferences = 150;
  const auto costs = random_costs(kQueries, kReferences, 2);
  std::vector<std::vector<double>> scores(kQueries);
  for (std::size_t q = 0; q < kQueries; ++q) {
    const std::vector<double> row(costs.row(q).begin(), costs.row(q).end());
    for (const double value : row) scores[q].push_back(standard_score(value, row, 0));
  }
  const auto result = enhanced(costs, Enhancement::kStandardise);
  for (std::size_t r = 0; r < kReferences; ++r) {
    std::vector<double> column;
    for (std::size_t q = 0; q < kQueries; ++q) column.push_back(scores[q][r]);
    for (std::size_t q = 0; q < kQueries; ++q)
      EXPECT_NEAR(result.at(q, r), standard_score(column[q], column, 0), kFloatRounding);
  }
}

TEST(EnhanceStandardise, WithAPriorDrawsColumnsTowardsDoingNothing) {
  constexpr std::size_t kQueries = 9, kReferences = 150;
  constexpr double kPrior = 27, kShare = 0.25;  // 9 / (9 + 27)
  const auto costs = random_costs(kQueries, kReferences, 2);
  std::vector<std::vector<double>> scores(kQueries);
  for (std::size_t q = 0; q < kQueries; ++q) {
    const std::vector<double> row(costs.row(q).begin(), costs.row(q).end());
    for (const double value : row) scores[q].push_back(standard_score(value, row, 0));
  }
  auto result = costs;
  const place::ContrastEnhancementOptions options{.prior_queries = kPrior};
  place::enhance_contrast(result, options);
  place::ContrastEnhancer enhancer(kQueries, kReferences, options);
  enhancer.survey(block_of(costs), kReferences);
  for (std::size_t r = 0; r < kReferences; ++r) {
    double mean = 0, variance = 0;
    for (const auto& row : scores) mean += row[r] / kQueries;
    for (const auto& row : scores) variance += (row[r] - mean) * (row[r] - mean) / kQueries;
    for (std::size_t q = 0; q < kQueries; ++q) {
      EXPECT_NEAR(result.at(q, r), (scores[q][r] - kShare * mean) / std::sqrt(kShare * variance + 1 - kShare),
                  kFloatRounding);
      EXPECT_LE(std::abs(result.at(q, r)), enhancer.range().largest);
    }
  }
}

TEST(EnhanceStandardise, OfOneQueryWithAPriorIsItsStandardScore) {
  // Alone, a query has no deviation over the queries, and without a prior nothing is left of it.
  const auto costs = random_costs(1, 40, 6);
  auto result = costs;
  place::enhance_contrast(result, {.prior_queries = 1e9});
  const std::vector<double> row(costs.row(0).begin(), costs.row(0).end());
  for (std::size_t r = 0; r < 40; ++r)
    EXPECT_NEAR(result.at(0, r), standard_score(row[r], row, 0), kFloatRounding);
}

TEST(EnhanceStandardise, TakesOutWhatAQueryOrAReferenceHasInGeneral) {
  // A dark query (all costs larger, of larger spread) changes nothing.
  const auto costs = random_costs(8, 30, 3);
  auto darker = costs;
  for (float& value : darker.row(5)) value = 3 * value + 2;
  const auto a = enhanced(costs, Enhancement::kStandardise), b = enhanced(darker, Enhancement::kStandardise);
  for (std::size_t k = 0; k < a.values.size(); ++k) EXPECT_NEAR(a.values[k], b.values[k], kFloatRounding);
}

TEST(EnhanceContrast, OfEqualCostsIsZero) {
  for (const auto method : {Enhancement::kLocal, Enhancement::kStandardise}) {
    for (const float value : {0.0F, 0.1F, 1.0F / 3, 7.0F}) {
      place::CostMatrix costs = place::make_cost_matrix(7, 90);
      std::ranges::fill(costs.values, value);
      EXPECT_THAT(enhanced(costs, method).values, Each(0.0F)) << value;
    }
  }
}

TEST(EnhanceContrast, OfOneReferenceIsZero) {
  EXPECT_THAT(enhanced(random_costs(5, 1, 4), Enhancement::kLocal).values, Each(0.0F));
  EXPECT_THAT(enhanced(random_costs(5, 1, 4), Enhancement::kStandardise).values, Each(0.0F));
}

TEST(EnhanceContrast, OfOneQuery) {
  // Locally a query stands by itself; standardised over queries, one is as all are.
  const auto two = random_costs(2, 30, 5);
  const place::CostMatrix one{
      .queries = 1, .references = 30, .values = {two.row(0).begin(), two.row(0).end()}};
  EXPECT_THAT(enhanced(one, Enhancement::kLocal).values,
              testing::ElementsAreArray(enhanced(two, Enhancement::kLocal).row(0)));
  EXPECT_THAT(enhanced(one, Enhancement::kStandardise).values, Each(0.0F));
}

TEST(EnhanceContrast, OfNothingIsNothing) {
  for (const auto method : {Enhancement::kNone, Enhancement::kLocal, Enhancement::kStandardise}) {
    EXPECT_TRUE(enhanced(place::make_cost_matrix(0, 5), method).values.empty());
    EXPECT_TRUE(enhanced(place::make_cost_matrix(5, 0), method).values.empty());
  }
}

TEST(EnhanceContrast, NoneLeavesCostsAsTheyAre) {
  const auto costs = random_costs(4, 6, 6);
  EXPECT_EQ(enhanced(costs, Enhancement::kNone).values, costs.values);
}

/// Columns [first, past) of a matrix in memory of their own.
struct CutOut {
  CutOut(const place::CostMatrix& costs, std::size_t first, std::size_t past) : columns(past - first) {
    for (std::size_t q = 0; q < costs.queries; ++q)
      values.insert(values.end(), costs.row(q).begin() + static_cast<std::ptrdiff_t>(first),
                    costs.row(q).begin() + static_cast<std::ptrdiff_t>(past));
    block = {0, costs.queries, first, columns, values.data(), columns};
  }
  std::size_t columns;
  std::vector<float> values;
  place::Costs block;
};

TEST(ContrastEnhancer, GivesTheBitsOfTheWholeMatrixInParts) {
  constexpr std::size_t kQueries = 6, kReferences = 2 * place::ContrastEnhancer::kPart + 90;
  for (const auto method : {Enhancement::kNone, Enhancement::kLocal, Enhancement::kStandardise}) {
    for (const int window : {10, 100}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(method) << ", window " << window);
      auto costs = random_costs(kQueries, kReferences, 9);
      for (float& value : costs.values) value = std::exp(20 * value);  // of which running sums are not exact
      const auto whole = enhanced(costs, method, window);
      place::ContrastEnhancer enhancer(kQueries, kReferences, {.method = method, .window = window});
      const std::size_t margin = enhancer.margin();
      for (std::size_t first = 0; first < kReferences; first += place::ContrastEnhancer::kPart) {
        const std::size_t count = std::min(place::ContrastEnhancer::kPart, kReferences - first);
        enhancer.survey(
            CutOut(costs, first - std::min(first, margin), std::min(kReferences, first + count + margin))
                .block,
            count);
      }
      // From several aligned beginnings, wherever they end.
      for (const auto& [first, past] :
           {std::pair<std::size_t, std::size_t>{0, 333}, {64, 700}, {480, kReferences}}) {
        CutOut part(costs, first, past);
        enhancer.enhance(part.block);
        const std::size_t valid = first == 0 ? 0 : first + margin,
                          valid_past = past == kReferences ? past : past - margin;
        for (std::size_t q = 0; q < kQueries; ++q) {
          const auto own = part.block.columns(valid, valid_past - valid).row(q);
          EXPECT_TRUE(std::ranges::equal(own, whole.row(q).subspan(valid, valid_past - valid)))
              << q << " from " << first;
        }
      }
      const place::CostRange range = enhancer.range(), exact = place::range_of(whole.values);
      EXPECT_NEAR(range.centre, exact.centre, kFloatRounding * std::max(1.0, exact.largest));
      for (const float value : whole.values)
        EXPECT_LE(std::abs(value - range.centre), range.largest * (1 + 1e-12));
    }
  }
}

TEST(ContrastEnhancer, WantsPartsInOrderAndAllOfThem) {
  constexpr std::size_t kPart = place::ContrastEnhancer::kPart;
  auto costs = random_costs(3, kPart + 40, 10);
  place::ContrastEnhancer enhancer(3, kPart + 40, {.method = Enhancement::kLocal});
  const std::size_t margin = enhancer.margin();
  EXPECT_EQ(margin % place::ContrastEnhancer::kAlign, 0U);
  const place::Costs all = place::block_of(costs);
  EXPECT_THROW(enhancer.enhance(all), std::invalid_argument);                               // no survey yet
  EXPECT_THROW(enhancer.survey(all.columns(0, kPart), kPart), std::invalid_argument);       // no margin
  EXPECT_THROW(enhancer.survey(all.columns(0, 100 + margin), 100), std::invalid_argument);  // an odd part
  EXPECT_THROW(enhancer.survey(all.columns(kPart - margin, 40 + margin), 40),
               std::invalid_argument);  // too soon
  enhancer.survey(all.columns(0, kPart + margin), kPart);
  EXPECT_THROW(enhancer.enhance(all), std::invalid_argument);  // half a survey
  EXPECT_THROW(enhancer.survey(all.columns(kPart - margin, 40 + margin), 41), std::invalid_argument);
  enhancer.survey(all.columns(kPart - margin, 40 + margin), 40);
  EXPECT_THROW(enhancer.enhance(all.columns(7, 40)), std::invalid_argument);  // not aligned
  EXPECT_NO_THROW(enhancer.enhance(all));
}

TEST(EnhanceContrast, IsTheSameForAnyThreadCount) {
  const auto costs = random_costs(40, 300, 7);
  for (const auto method : {Enhancement::kLocal, Enhancement::kStandardise}) {
    vo::set_thread_count(1);
    const auto one = enhanced(costs, method);
    vo::set_thread_count(4);
    EXPECT_EQ(enhanced(costs, method).values, one.values);
  }
  vo::set_thread_count(0);
}

TEST(EnhanceContrast, RefusesAWindowWithoutNeighbours) {
  auto costs = random_costs(2, 2, 8);
  EXPECT_THROW(place::enhance_contrast(costs, {.window = 1}), std::invalid_argument);
  EXPECT_THROW(place::enhance_contrast(costs, {.prior_queries = -1}), std::invalid_argument);
}

}  // namespace
