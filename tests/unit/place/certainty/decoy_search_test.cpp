#include "support/drawn_costs.hpp"

#include <algorithm>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/certainty/decoy_search.hpp>

namespace {

using place::decoy_scores;
using place::search_method;
using test_support::walked_costs;
using testing::IsEmpty;
using testing::SizeIs;

/// Passes the scores of the first column through, so that what a search is given can be seen.
place::SearchResult first_costs(const place::CostView& enhanced, const place::SearchOptions& options) {
  place::SearchResult result;
  for (std::size_t q = 0; q < enhanced.queries; ++q) {
    const auto steps = options.path.steps.empty() ? 0.0F : static_cast<float>(options.path.steps[q]);
    const bool at_gap = std::ranges::find(options.gaps.query, q) != options.gaps.query.end();
    result.matches.push_back(
        {.reference = 0, .score = enhanced.at(q, 0) + 100 * steps + (at_gap ? 0.5F : 0)});
  }
  return result;
}

TEST(DecoyScores, SearchTheWalkBackwards) {
  auto costs = place::make_cost_matrix(5, 2);
  for (std::size_t q = 0; q < 5; ++q) costs.row(q)[0] = static_cast<float>(q);
  // Steps to keyframes 1 .. 4 are 1 .. 4: backwards, to the second keyframe it is 4. The gap between 1 and 2
  // lies between the third and the fourth.
  place::SearchOptions options;
  options.path.steps = {0, 1, 2, 3, 4};
  options.gaps.query = {0, 2};
  const place::SearchMethod method{.name = "first", .summary = "", .search = first_costs};
  EXPECT_THAT(decoy_scores(costs, method, options),
              testing::ElementsAre(4, 3 + 400, 2 + 300, 1 + 200 + 0.5, 0 + 100));
}

TEST(DecoyScores, AreLowWhereTheWalkItselfIsFound) {
  const auto costs = walked_costs(100, 120, 10, 1, 3.0F, 1);
  for (const place::SearchMethod& method : place::search_methods()) {
    auto decoys = decoy_scores(costs, method, {});
    auto real = method.search(costs, {}).matches;
    std::ranges::sort(decoys);
    std::size_t above = 0;
    for (const place::SequenceMatch& match : real)
      above += static_cast<std::size_t>(decoys.empty() || match.score > decoys[decoys.size() * 9 / 10]);
    EXPECT_GE(above, 90U) << method.name;
  }
}

TEST(DecoyScores, LeaveOutWhatWasNotMatched) {
  EXPECT_THAT(decoy_scores(place::make_cost_matrix(4, 0), search_method("lines"), {}), IsEmpty());
  EXPECT_THAT(decoy_scores(place::make_cost_matrix(0, 4), search_method("path"), {}), IsEmpty());
  EXPECT_THAT(decoy_scores(place::make_cost_matrix(1, 1), search_method("path"), {}), SizeIs(1));
}

}  // namespace
