#include "support/drawn_costs.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/search_method.hpp>
#include <vo/base/error.hpp>

namespace {

using test_support::walked_costs;
using testing::HasSubstr;
using testing::SizeIs;

TEST(SearchMethod, TheFirstIsLines) {
  ASSERT_FALSE(place::search_methods().empty());
  EXPECT_EQ(place::search_methods().front().name, "lines");
}

TEST(SearchMethod, AreFoundByTheirNames) {
  for (const place::SearchMethod& method : place::search_methods()) {
    EXPECT_EQ(&place::search_method(method.name), &method);
    EXPECT_FALSE(method.summary.empty());
  }
}

TEST(SearchMethod, AnUnknownNameIsAnsweredWithTheKnownOnes) {
  try {
    place::search_method("rays");
    FAIL() << "an error expected";
  } catch (const vo::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'rays'"));
    for (const place::SearchMethod& method : place::search_methods())
      EXPECT_THAT(error.what(), HasSubstr(std::string(method.name)));
  }
}

TEST(SearchMethod, EachFindsAPlainWalk) {
  const auto costs = walked_costs(80, 150, 30, 1, 4.0F, 3);
  for (const place::SearchMethod& method : place::search_methods()) {
    const auto result = method.search(costs, {});
    ASSERT_THAT(result.matches, SizeIs(80)) << method.name;
    for (std::size_t q = 0; q < 80; ++q) EXPECT_EQ(result.matches[q].reference, q + 30) << method.name << q;
    EXPECT_GT(result.looked_at, 0) << method.name;
    EXPECT_LE(result.looked_at, 1) << method.name;
  }
}

TEST(SearchMethod, NoneCrossesAGap) {
  // Both walks were interrupted for a while in which they went another way: queries 40 on are at references
  // 70 on, and across the gap neither goes on as it did.
  auto costs = walked_costs(80, 150, 20, 1, 0.0F, 5);
  for (std::size_t q = 0; q < 80; ++q) costs.row(q)[q < 40 ? q + 20 : q + 30] -= 4;
  for (const place::SearchMethod& method : place::search_methods()) {
    const auto result = method.search(costs, {.gaps = {.query = {40}, .reference = {65}}});
    for (std::size_t q = 0; q < 80; ++q)
      EXPECT_EQ(result.matches[q].reference, q < 40 ? q + 20 : q + 30) << method.name << q;
  }
}

TEST(SearchMethod, EachTakesAWalkOfNothing) {
  for (const place::SearchMethod& method : place::search_methods()) {
    EXPECT_THAT(method.search(place::make_cost_matrix(0, 20), {}).matches, SizeIs(0)) << method.name;
    EXPECT_THAT(method.search(place::make_cost_matrix(4, 0), {}).matches, SizeIs(4)) << method.name;
  }
}

TEST(SearchMethod, LinesScoreByTheRatioOfTheOriginalIfAskedTo) {
  // By the definition, from costs of single keyframes: a of the least of a row, b of the least outside the
  // window, both over the least of all.
  const auto costs = walked_costs(30, 60, 10, 1, 4.0F, 3);
  place::SearchOptions options;
  options.sequence.length = 1;
  options.sequence.min_fraction = 1;
  options.sequence.score = place::MatchScore::kRatio;
  const auto found = place::search_method("lines").search(costs, options);
  options.sequence.score = place::MatchScore::kDifference;
  const auto by_difference = place::search_method("lines").search(costs, options);
  const double least = *std::ranges::min_element(costs.values);
  for (std::size_t q = 0; q < 30; ++q) {
    const std::size_t best = *found.matches[q].reference;
    EXPECT_EQ(best, by_difference.matches[q].reference);
    double a = costs.row(q)[best], b = 1e9;
    for (std::size_t r = 0; r < 60; ++r)
      if (std::max(r, best) - std::min(r, best) > 10) b = std::min<double>(b, costs.row(q)[r]);
    EXPECT_NEAR(found.matches[q].score, 1 - (a - least) / (b - least),
                1e-4);  // costs are rounded to 2^-20 or so
    EXPECT_GE(found.matches[q].score, 0);
    EXPECT_LE(found.matches[q].score, 1);
  }
}

}  // namespace
