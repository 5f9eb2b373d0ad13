#include "support/drawn_costs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/certainty/decoy_search.hpp>
#include <place/certainty/place_spread.hpp>
#include <place/certainty/sure_search.hpp>
#include <place/match/search_path.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::ProbabilitySource;
using place::search_method;
using place::search_surely;
using place::SureMatch;
using test_support::chance_costs;
using test_support::walked_costs;
using testing::IsEmpty;

TEST(SearchSurely, JoinsWhatItsStagesFind) {
  const auto costs = walked_costs(60, 80, 10, 1, 2.5F, 1);
  const place::SearchMethod& method = search_method("lines");
  const auto sure = search_surely(costs, method, {});
  const auto matches = method.search(costs, {}).matches;
  const auto spread = place::place_spread(costs, matches);
  std::vector<double> scores;
  for (const auto& match : matches) scores.push_back(match.score);
  const auto probabilities = place::match_probabilities(scores, place::decoy_scores(costs, method, {}),
                                                        {.decoy_quantile = method.decoy_quantile});
  const place::SearchMethod& path = search_method("path");
  std::vector<double> odds;
  for (const auto& match : place::path_scores(costs, matches, {})) odds.push_back(match.score);
  const auto by_path = place::match_probabilities(odds, place::decoy_scores(costs, path, {}),
                                                  {.decoy_quantile = path.decoy_quantile});
  ASSERT_EQ(sure.source, ProbabilitySource::kDecoys);
  EXPECT_EQ(sure.wrong_share, probabilities.wrong_share);
  for (std::size_t q = 0; q < matches.size(); ++q) {
    EXPECT_TRUE(test_support::same(sure.matches[q].match, matches[q])) << q;
    EXPECT_EQ(sure.matches[q].sd_keyframes, spread[q]) << q;
    EXPECT_DOUBLE_EQ(*sure.matches[q].probability,
                     std::max(probabilities.probability[q],
                              std::min(by_path.probability[q], 1 / (1 + std::exp(-odds[q])))))
        << q;
  }
}

TEST(SearchSurely, IsSureOfAPlainWalkAndOfNoOther) {
  for (const place::SearchMethod& method : place::search_methods()) {
    for (const SureMatch& match : search_surely(walked_costs(100, 140, 20, 1, 4.0F, 2), method, {}).matches)
      EXPECT_GT(match.probability.value_or(0), 0.9) << method.name;
    // Of a hundred chance matches some look good; that many do not.
    std::size_t sure = 0;
    for (const SureMatch& match : search_surely(chance_costs(100, 140, 3), method, {}).matches)
      sure += static_cast<std::size_t>(match.probability.value_or(0) > 0.9);
    EXPECT_LE(sure, 10U) << method.name;
  }
}

TEST(SearchSurely, TrustsLinesThatLieOnOnePath) {
  // Every place looks almost like the one 40 further: single lines are hardly distinct, but those that are
  // right all lie on one path.
  auto costs = walked_costs(100, 140, 20, 1, 2.5F, 7);
  for (std::size_t q = 0; q < 60; ++q) costs.row(q)[q + 60] -= 2.2F;
  const place::SearchMethod& method = search_method("lines");
  const auto lines = search_surely(costs, method, {});
  const auto matches = method.search(costs, {}).matches;
  std::vector<double> scores;
  for (const auto& match : matches) scores.push_back(match.score);
  const auto alone = place::match_probabilities(scores, place::decoy_scores(costs, method, {}),
                                                {.decoy_quantile = method.decoy_quantile});
  const auto on_path = place::path_scores(costs, matches, {});
  double with_path = 0, without = 0;
  for (std::size_t q = 0; q < matches.size(); ++q) {
    EXPECT_GE(*lines.matches[q].probability, alone.probability[q]) << q;
    if (on_path[q].score < 0) {  // elsewhere rather than here
      EXPECT_LE(*lines.matches[q].probability, std::max(alone.probability[q], 0.5)) << q;
    }
    const double off = static_cast<double>(*matches[q].reference) - static_cast<double>(q + 20);
    if (q >= 60 || std::abs(off) > 2) continue;
    with_path += *lines.matches[q].probability;
    without += alone.probability[q];
  }
  EXPECT_GT(with_path, without);
}

TEST(SearchSurely, IsNoSurerThanASearchOfLogOdds) {
  // A walk that looks a little like the route all along: more than played backwards, less than the path asks.
  const auto costs = walked_costs(60, 80, 10, 1, 1.2F, 6);
  const place::SearchMethod& method = search_method("path");
  const auto sure = search_surely(costs, method, {});
  std::vector<double> scores;
  for (const SureMatch& match : sure.matches) scores.push_back(match.match.score);
  const auto by_decoys = place::match_probabilities(scores, place::decoy_scores(costs, method, {}),
                                                    {.decoy_quantile = method.decoy_quantile});
  for (std::size_t q = 0; q < scores.size(); ++q)
    EXPECT_DOUBLE_EQ(*sure.matches[q].probability,
                     std::min(by_decoys.probability[q], 1 / (1 + std::exp(-scores[q]))));
}

TEST(SearchSurely, OfAShortWalkGivesWhatTheSearchHas) {
  const auto costs = walked_costs(6, 40, 20, 1, 5.0F, 4);
  const auto lines = search_surely(costs, search_method("lines"), {});
  EXPECT_EQ(lines.source, ProbabilitySource::kNone);
  EXPECT_EQ(lines.matches[3].match.reference, 23U);
  EXPECT_EQ(lines.matches[3].probability, std::nullopt);
  EXPECT_TRUE(lines.matches[3].sd_keyframes);
  const auto path = search_surely(costs, search_method("path"), {});
  EXPECT_EQ(path.source, ProbabilitySource::kSearch);
  for (const SureMatch& match : path.matches)
    EXPECT_DOUBLE_EQ(*match.probability, 1 / (1 + std::exp(-static_cast<double>(match.match.score))));
}

TEST(SearchSurely, GivesNothingForNothing) {
  for (const place::SearchMethod& method : place::search_methods()) {
    EXPECT_THAT(search_surely(place::make_cost_matrix(0, 4), method, {}).matches, IsEmpty());
    const auto none = search_surely(place::make_cost_matrix(3, 0), method, {});
    EXPECT_EQ(none.source, ProbabilitySource::kNone);
    EXPECT_EQ(none.matches[0].probability, std::nullopt);
  }
}

TEST(SearchSurely, IsTheSameForAnyThreadCount) {
  const auto costs = walked_costs(80, 60, 0, 0.7, 1.5F, 5);
  for (const place::SearchMethod& method : place::search_methods()) {
    vo::set_thread_count(1);
    const auto one = search_surely(costs, method, {});
    vo::set_thread_count(4);
    const auto four = search_surely(costs, method, {});
    vo::set_thread_count(0);
    for (std::size_t q = 0; q < costs.queries; ++q) {
      EXPECT_TRUE(test_support::same(one.matches[q].match, four.matches[q].match)) << method.name << q;
      EXPECT_EQ(one.matches[q].probability, four.matches[q].probability) << method.name << q;
    }
  }
}

}  // namespace
