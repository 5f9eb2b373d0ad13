#include "match/search_by_stretches.hpp"

#include "support/drawn_costs.hpp"

#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/sequence_searcher.hpp>

namespace {

using place::search_by_stretches;
using place::SequenceSearchOptions;
using test_support::chance_costs;
using testing::IsEmpty;

auto lines(const SequenceSearchOptions& options) {
  // Costs are compared over stretches, so all are centred on the same mean.
  return [=](const place::CostView& part) {
    place::SequenceSearcher searcher(part.queries, part.references, {.centre = 0, .largest = 4}, options);
    searcher.push(place::block_of(part), part.references);
    return searcher.finish();
  };
}

TEST(SearchByStretches, IsTheSearchItselfWithoutGaps) {
  const auto costs = chance_costs(30, 40, 1);
  const SequenceSearchOptions options{.length = 6};
  const auto whole = lines(options)(costs);
  const auto found = search_by_stretches(costs, options, {.query = {0, 30}, .reference = {}}, lines(options));
  for (std::size_t q = 0; q < whole.size(); ++q) EXPECT_TRUE(test_support::same(found[q], whole[q])) << q;
}

TEST(SearchByStretches, FindsWalksThatGoOnElsewhereAfterAGap) {
  // The clock jumps: queries 10 on are at reference 35 on. A line across the gap would count strangers in.
  auto costs = place::make_cost_matrix(20, 60);
  for (std::size_t q = 0; q < 20; ++q) costs.row(q)[q < 10 ? q : q + 25] = -1;
  const auto found =
      search_by_stretches(costs, {.length = 6}, {.query = {10}, .reference = {}}, lines({.length = 6}));
  for (std::size_t q = 0; q < 20; ++q) EXPECT_EQ(found[q].reference, q < 10 ? q : q + 25) << q;
  EXPECT_EQ(found[9].terms, 4);   // 6 .. 9
  EXPECT_EQ(found[10].terms, 3);  // 10 .. 12
}

TEST(SearchByStretches, TakesTheCheapestOfTheReferencesStretches) {
  auto costs = place::make_cost_matrix(12, 60);
  for (std::size_t q = 0; q < 12; ++q) {
    costs.row(q)[q + 5] = -1;
    costs.row(q)[q + 35] = -2;
  }
  const auto found =
      search_by_stretches(costs, {.length = 4}, {.query = {}, .reference = {30}}, lines({.length = 4}));
  for (std::size_t q = 2; q < 10; ++q) {
    EXPECT_EQ(found[q].reference, q + 35) << q;
    EXPECT_FLOAT_EQ(found[q].cost, -2) << q;
    EXPECT_FLOAT_EQ(found[q].score, 1) << q;  // against the line on the other side of the gap
  }
}

TEST(SearchByStretches, GivesNothingForNothing) {
  EXPECT_THAT(
      search_by_stretches(place::make_cost_matrix(0, 0), {}, {.query = {1}, .reference = {1}}, lines({})),
      IsEmpty());
}

TEST(JoinStretches, GivesTheSameInAnyOrder) {
  const place::SequenceMatch a{.reference = 0, .cost = -3, .score = 3},
      b{.reference = 100, .cost = -3.5F, .score = 3.5F}, c{.reference = 105, .cost = -4, .score = 4};
  using place::join_stretches;
  EXPECT_EQ(join_stretches(join_stretches(a, b, 10), c, 10).score, 1);
  EXPECT_EQ(join_stretches(join_stretches(a, c, 10), b, 10).score, 1);
}

}  // namespace
