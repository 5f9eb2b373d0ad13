#include "support/drawn_costs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/search_hybrid.hpp>
#include <place/match/search_lines.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::SequenceSearchOptions;
using test_support::chance_costs;
using test_support::walked_costs;
using testing::Each;
using testing::Field;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The documented cost of a pair, from its cone cell by cell; infinite with too few terms.
double brute_force_cost(const place::CostMatrix& costs, const SequenceSearchOptions& options, int q, int r) {
  const auto lines = place::search_lines(options);
  double sum = 0;
  int terms = 0;
  for (int k = 0; k < options.length; ++k) {
    const int query = q + k - options.length / 2;
    if (query < 0 || query >= static_cast<int>(costs.queries)) continue;
    const auto at = static_cast<std::size_t>(k);
    const int a = r + lines.front().offsets[at], b = r + lines.back().offsets[at];
    double least = kInfinity;
    for (int other = std::min(a, b); other <= std::max(a, b); ++other) {
      if (other < 0 || other >= static_cast<int>(costs.references)) continue;
      least =
          std::min<double>(least, costs.at(static_cast<std::size_t>(query), static_cast<std::size_t>(other)));
    }
    if (least == kInfinity) continue;
    sum += least;
    ++terms;
  }
  if (terms == 0 || terms < options.min_fraction * options.length) return kInfinity;
  return sum / std::sqrt(1.0 * terms * options.length);
}

void expect_equal_to_brute_force(const place::CostMatrix& costs, const SequenceSearchOptions& options) {
  const auto matches = place::search_hybrid(costs, options);
  ASSERT_EQ(matches.size(), costs.queries);
  constexpr double kRounding = 1e-5;  // sums are exact; of one product in float, of values up to 30
  for (std::size_t q = 0; q < costs.queries; ++q) {
    SCOPED_TRACE(q);
    std::vector<double> pairs(costs.references);
    for (std::size_t r = 0; r < pairs.size(); ++r)
      pairs[r] = brute_force_cost(costs, options, static_cast<int>(q), static_cast<int>(r));
    const double least = *std::min_element(pairs.begin(), pairs.end());
    ASSERT_EQ(matches[q].reference.has_value(), least < kInfinity);
    if (!matches[q].reference) continue;
    const std::size_t found = *matches[q].reference;
    EXPECT_NEAR(matches[q].cost, least, kRounding);
    EXPECT_NEAR(pairs[found], least, kRounding);
    double elsewhere = kInfinity;
    for (std::size_t r = 0; r < pairs.size(); ++r) {
      if (std::max(r, found) - std::min(r, found) > static_cast<std::size_t>(options.uniqueness_window))
        elsewhere = std::min(elsewhere, pairs[r]);
    }
    EXPECT_NEAR(matches[q].score, (elsewhere < kInfinity ? elsewhere : 0) - least, kRounding);
  }
}

TEST(SearchHybrid, EqualsBruteForce) {
  for (const double range : {0.0, 0.1, 0.5, 0.75}) {
    for (const int length : {1, 2, 5, 10}) {
      SCOPED_TRACE(testing::Message() << range << " rad, length " << length);
      const SequenceSearchOptions options{
          .length = length, .search_range_rad = range, .uniqueness_window = 3};
      expect_equal_to_brute_force(walked_costs(14, 23, 4, 1.1, 1.5F, 7), options);
      expect_equal_to_brute_force(chance_costs(9, 5, 8), options);
    }
  }
}

TEST(SearchHybrid, EqualsBruteForceAcrossBlocksOfQueries) {
  // Blocks have at most 64 queries.
  expect_equal_to_brute_force(walked_costs(140, 30, 0, 0.2, 1.0F, 9), {.length = 6, .search_range_rad = 0.3});
}

TEST(SearchHybrid, IsTheSearchOfLinesWhereTheConeIsALine) {
  auto costs = chance_costs(30, 40, 11);
  // Lines are centred on the mean: make it 0.
  for (std::size_t k = 0; k < 600; ++k) costs.values[600 + k] = -costs.values[k];
  const SequenceSearchOptions options{.length = 7, .search_range_rad = 0};
  const auto lines = place::search_sequences(costs, options), hybrid = place::search_hybrid(costs, options);
  for (std::size_t q = 0; q < costs.queries; ++q) {
    EXPECT_EQ(hybrid[q].reference, lines[q].reference) << q;
    EXPECT_NEAR(hybrid[q].cost, lines[q].cost, 1e-5) << q;  // lines are summed in integers
  }
}

TEST(SearchHybrid, FindsAWalkThatChangesItsSpeed) {
  place::CostMatrix costs = place::make_cost_matrix(10, 40);
  const std::vector<std::size_t> places{10, 12, 13, 15, 16, 18, 18, 19, 19, 20};
  for (std::size_t q = 0; q < places.size(); ++q) costs.row(q)[places[q]] = -1;
  const auto matches = place::search_hybrid(costs, {.length = 10, .v_min = 0.4, .v_max = 1.8});
  EXPECT_EQ(matches[5].reference, 18U);
  EXPECT_FLOAT_EQ(matches[5].cost, -1);
}

TEST(SearchHybrid, GivesNothingForNothing) {
  EXPECT_THAT(place::search_hybrid(place::make_cost_matrix(0, 5)), IsEmpty());
  EXPECT_THAT(place::search_hybrid(place::make_cost_matrix(3, 0)),
              Each(Field(&place::SequenceMatch::reference, std::nullopt)));
}

TEST(SearchHybrid, TakesTheFirstOfEqualReferences) {
  const auto matches = place::search_hybrid(place::make_cost_matrix(4, 30), {.length = 1});
  EXPECT_EQ(matches[0].reference, 0U);
  EXPECT_EQ(matches[0].score, 0);
}

TEST(SearchHybrid, IsTheSameForAnyThreadCount) {
  const auto costs = walked_costs(100, 80, 3, 0.7, 1.0F, 5);
  vo::set_thread_count(1);
  const auto one = place::search_hybrid(costs, {.length = 9, .search_range_rad = 0.4});
  vo::set_thread_count(4);
  const auto four = place::search_hybrid(costs, {.length = 9, .search_range_rad = 0.4});
  vo::set_thread_count(0);
  for (std::size_t q = 0; q < one.size(); ++q) EXPECT_TRUE(test_support::same(one[q], four[q])) << q;
}

TEST(SearchHybrid, RefusesOptionsThatAreNotValid) {
  EXPECT_THROW(place::search_hybrid(place::make_cost_matrix(3, 3), {.length = 0}), std::invalid_argument);
}

}  // namespace
