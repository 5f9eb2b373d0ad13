#include "support/drawn_costs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/search_graph.hpp>
#include <place/match/search_method.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::SearchOptions;
using test_support::chance_costs;
using test_support::walked_costs;
using testing::Each;
using testing::Field;
using testing::IsEmpty;

/// What the cheapest path through all queries costs, by dynamic programming over every cell; starts in any
/// reference of the first query.
double cheapest_path(const place::CostMatrix& costs, const place::GraphSearchOptions& options) {
  const auto weight = [&](std::size_t q, std::size_t r) {
    return std::exp(std::min<double>(options.hidden_cost, costs.at(q, r)));
  };
  std::vector<double> to(costs.references);
  for (std::size_t r = 0; r < to.size(); ++r) to[r] = weight(0, r);
  for (std::size_t q = 1; q < costs.queries; ++q) {
    std::vector<double> next(to.size(), std::numeric_limits<double>::infinity());
    for (std::size_t r = 0; r < to.size(); ++r) {
      for (std::size_t from = 0; from <= r; ++from) {
        if (r - from <= static_cast<std::size_t>(options.fan_out))
          next[r] = std::min(next[r], to[from] + weight(q, r));
      }
    }
    to = next;
  }
  return *std::min_element(to.begin(), to.end());
}

double cost_of(const std::vector<place::SequenceMatch>& path) {
  double sum = 0;
  for (const place::SequenceMatch& match : path) sum += std::exp(static_cast<double>(match.cost));
  return sum;
}

TEST(SearchGraph, FindsTheCheapestPathWhereItFollowsAllThatMayBeIt) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto costs = walked_costs(25, 30, 2, 1, 1.0F, seed);
    // Nothing is hidden, so the walk is never lost and every node of the path is a match.
    const SearchOptions options{.graph = {.fan_out = 3, .hidden_cost = 10, .expansion_rate = 0}};
    const auto result = place::search_graph(costs, options);
    for (std::size_t q = 1; q < costs.queries; ++q) {
      ASSERT_TRUE(result.matches[q].reference);
      const auto step = static_cast<std::ptrdiff_t>(*result.matches[q].reference) -
                        static_cast<std::ptrdiff_t>(*result.matches[q - 1].reference);
      EXPECT_GE(step, 0) << q;
      EXPECT_LE(step, 3) << q;
    }
    EXPECT_NEAR(cost_of(result.matches), cheapest_path(costs, options.graph), 1e-9);  // sums of 25 doubles
  }
}

TEST(SearchGraph, FollowsAPlainWalkAndLooksAtFewCells) {
  const auto costs = walked_costs(60, 200, 20, 1, 4.0F, 4);
  const auto result = place::search_graph(costs, {});
  for (std::size_t q = 0; q < costs.queries; ++q) EXPECT_EQ(result.matches[q].reference, q + 20) << q;
  // The whole first row, and for each further query the six successors of a node or two.
  EXPECT_LT(result.looked_at, (200 + 60 * 2 * 6) / (60.0 * 200));
  EXPECT_GE(result.looked_at, (200 + 59 * 6) / (60.0 * 200));
}

TEST(SearchGraph, PassesPicturesThatMatchNowhere) {
  auto costs = walked_costs(40, 60, 5, 1, 6.0F, 6);
  for (const std::size_t q : {10U, 11U, 25U}) std::ranges::fill(costs.row(q), 1.0F);
  const auto result = place::search_graph(costs, {});
  for (std::size_t q = 0; q < costs.queries; ++q) {
    const bool hidden = q == 10 || q == 11 || q == 25;
    EXPECT_EQ(result.matches[q].reference, hidden ? std::nullopt : std::optional(q + 5)) << q;
  }
}

TEST(SearchGraph, FindsAWalkAgainThatWasLost) {
  // It leaves the route for eight queries and comes back elsewhere, further than any fan reaches.
  auto costs = place::make_cost_matrix(40, 100);
  std::ranges::fill(costs.values, 1.0F);
  for (std::size_t q = 0; q < 15; ++q) costs.row(q)[q] = -3;
  for (std::size_t q = 23; q < 40; ++q) costs.row(q)[q + 50] = -3;
  const auto result = place::search_graph(costs, {});
  for (std::size_t q = 0; q < 15; ++q) EXPECT_EQ(result.matches[q].reference, q);
  for (std::size_t q = 15; q < 23; ++q) EXPECT_EQ(result.matches[q].reference, std::nullopt);
  for (std::size_t q = 23; q < 40; ++q) EXPECT_EQ(result.matches[q].reference, q + 50);
}

TEST(SearchGraph, ScoresByHowFarBelowHiddenThePathRuns) {
  auto costs = place::make_cost_matrix(4, 3);
  for (std::size_t q = 0; q < 4; ++q) costs.row(q)[0] = q == 1 ? 0.0F : -3.0F;
  const auto result = place::search_graph(costs, {.sequence = {.length = 4}});
  EXPECT_FALSE(result.matches[1].reference);
  // Query 2 sees queries 0 .. 3: 2 + 0 + 2 + 2 over sqrt(4 * 4); query 3 sees 1 .. 3: 4 over sqrt(3 * 4).
  EXPECT_FLOAT_EQ(result.matches[2].score, 1.5F);
  EXPECT_FLOAT_EQ(result.matches[3].score, static_cast<float>(4 / std::sqrt(12.0)));
  EXPECT_EQ(result.matches[3].terms, 3);
}

TEST(SearchGraph, CrossesNoGap) {
  auto costs = place::make_cost_matrix(20, 20);
  std::ranges::fill(costs.values, 1.0F);
  for (std::size_t q = 0; q < 20; ++q) costs.row(q)[q] = -3;
  const auto reference_gap = place::search_graph(costs, {.gaps = {.query = {}, .reference = {10}}});
  EXPECT_EQ(reference_gap.matches[9].reference, 9U);
  EXPECT_FALSE(reference_gap.matches[10].reference);  // until it counts as lost
  EXPECT_EQ(reference_gap.matches[19].reference, 19U);
  const auto both = place::search_graph(costs, {.gaps = {.query = {10}, .reference = {10}}});
  for (std::size_t q = 0; q < 20; ++q) EXPECT_EQ(both.matches[q].reference, q) << q;
}

TEST(SearchGraph, GivesNothingForNothing) {
  EXPECT_THAT(place::search_graph(place::make_cost_matrix(0, 5), {}).matches, IsEmpty());
  EXPECT_THAT(place::search_graph(place::make_cost_matrix(3, 0), {}).matches,
              Each(Field(&place::SequenceMatch::reference, std::nullopt)));
  // Constant costs are average ones: nothing is alike.
  EXPECT_THAT(place::search_graph(place::make_cost_matrix(12, 12), {}).matches,
              Each(Field(&place::SequenceMatch::reference, std::nullopt)));
  auto one = place::make_cost_matrix(1, 1);
  one.values[0] = -2;
  EXPECT_EQ(place::search_graph(one, {}).matches[0].reference, 0U);
}

TEST(SearchGraph, RefusesOptionsThatAreNotValid) {
  const auto costs = place::make_cost_matrix(3, 3);
  EXPECT_THROW(place::search_graph(costs, {.graph = {.fan_out = 0}}), std::invalid_argument);
  EXPECT_THROW(place::search_graph(costs, {.graph = {.expansion_rate = 1.5}}), std::invalid_argument);
  EXPECT_THROW(place::search_graph(costs, {.sequence = {.length = 0}}), std::invalid_argument);
}

}  // namespace
