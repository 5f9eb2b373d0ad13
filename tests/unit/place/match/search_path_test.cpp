#include "support/drawn_costs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/search_method.hpp>
#include <place/match/search_path.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::SearchOptions;
using test_support::chance_costs;
using test_support::walked_costs;
using testing::Each;
using testing::Field;
using testing::IsEmpty;

/// Posteriors by the documented model, cell by cell in double: row q has the references, then "off the
/// route".
std::vector<std::vector<double>> brute_force_posteriors(const place::CostMatrix& costs,
                                                        const SearchOptions& options) {
  const std::size_t queries = costs.queries, references = costs.references, off = references;
  const auto likelihood = [&](std::size_t q, std::size_t r) {
    return r == off ? 1.0 : std::exp(-(std::clamp<double>(costs.at(q, r), -6, 6) + 1) / 2);
  };
  const auto crosses = [](const std::vector<std::size_t>& gaps, std::size_t from, std::size_t to) {
    return std::ranges::any_of(gaps, [&](std::size_t gap) { return gap > from && gap <= to; });
  };
  const double leave = 0.1 / options.sequence.length;
  const double range = options.sequence.search_range_rad, quarter = std::numbers::pi / 4;
  const double slowest = options.sequence.v_min.value_or(std::tan(quarter - range));
  const double fastest = options.sequence.v_max.value_or(std::tan(quarter + range));
  const double middle = options.sequence.v_min ? (slowest + fastest) / 2 : 1;
  const double half = std::min(5.0, (fastest - slowest) / 2);
  const auto transition = [&](std::size_t q, std::size_t from, std::size_t to) {
    if (from == off) return to == off ? 1 - leave : leave / static_cast<double>(references);
    const double step = middle * (options.path.steps.empty() ? 1 : options.path.steps[q]);
    const double deviation = std::sqrt(std::max(1.0, step) * (0.98 * 0.98 + half * half));
    double all = 0, inside = 0, here = 0;
    for (int s = 0; s <= step + 3.2 * deviation; ++s) {
      if (s < step - 3.2 * deviation) continue;
      const double p = std::exp(-(s - step) * (s - step) / (2 * deviation * deviation));
      const std::size_t at = from + static_cast<std::size_t>(s);
      all += p;
      if (at >= references || crosses(options.gaps.reference, from, at)) continue;
      inside += p;
      if (at == to) here = p;
    }
    return to == off ? 1 - (1 - leave) * inside / all : (1 - leave) * here / all;
  };
  std::vector<std::vector<double>> posteriors(queries, std::vector<double>(references + 1));
  for (const place::Stretch& stretch : place::stretches_between(options.gaps.query, queries)) {
    std::vector<std::vector<double>> forward(queries, std::vector<double>(references + 1));
    for (std::size_t q = stretch.begin; q < stretch.end; ++q) {
      double sum = 0;
      for (std::size_t r = 0; r <= references; ++r) {
        double before = 0;
        if (q == stretch.begin) {
          before = r == off ? 0.5 : 0.5 / static_cast<double>(references);
        } else {
          for (std::size_t from = 0; from <= references; ++from)
            before += forward[q - 1][from] * transition(q, from, r);
        }
        forward[q][r] = before * likelihood(q, r);
        sum += forward[q][r];
      }
      for (double& value : forward[q]) value /= sum;
    }
    std::vector<double> backward(references + 1, 1.0);
    for (std::size_t q = stretch.end; q-- > stretch.begin;) {
      double sum = 0;
      for (std::size_t r = 0; r <= references; ++r) {
        posteriors[q][r] = forward[q][r] * backward[r];
        sum += posteriors[q][r];
      }
      for (double& value : posteriors[q]) value /= sum;
      std::vector<double> before(references + 1);
      for (std::size_t from = 0; from <= references; ++from) {
        for (std::size_t to = 0; to <= references; ++to)
          before[from] += transition(q, from, to) * likelihood(q, to) * backward[to];
      }
      const double most = *std::ranges::max_element(before);
      for (double& value : before) value /= most;
      backward = before;
    }
  }
  return posteriors;
}

double triangle(const std::vector<double>& posterior, std::size_t at) {
  double sum = 0;
  for (std::size_t r = 0; r + 1 < posterior.size(); ++r) {
    const auto apart = static_cast<double>(std::max(r, at) - std::min(r, at));
    if (apart < 4) sum += (1 - apart / 4) * posterior[r];
  }
  return sum;
}

void expect_equal_to_brute_force(const place::CostMatrix& costs, const SearchOptions& options) {
  const auto result = place::search_path(costs, options);
  const auto posteriors = brute_force_posteriors(costs, options);
  ASSERT_EQ(result.matches.size(), costs.queries);
  // Floats carry 6e-8; every query's row goes through some ten roundings and a power of two good to 4e-6, and
  // they add up over at most 40 queries either way.
  constexpr double kRelative = 1e-3;
  const auto window = static_cast<std::size_t>(options.sequence.uniqueness_window);
  for (std::size_t q = 0; q < costs.queries; ++q) {
    SCOPED_TRACE(q);
    ASSERT_TRUE(result.matches[q].reference);
    const std::size_t found = *result.matches[q].reference;
    double most = 0, inside = 0, outside = 0;
    for (std::size_t r = 0; r < costs.references; ++r) {
      most = std::max(most, triangle(posteriors[q], r));
      (std::max(r, found) - std::min(r, found) <= window ? inside : outside) += posteriors[q][r];
    }
    outside += posteriors[q].back();
    EXPECT_GE(triangle(posteriors[q], found), most * (1 - kRelative));
    EXPECT_NEAR(result.matches[q].score, std::log(inside / outside), kRelative);
    EXPECT_EQ(result.matches[q].cost, costs.at(q, found));
  }
}

TEST(SearchPath, EqualsBruteForce) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    SearchOptions options;
    options.sequence.uniqueness_window = 3;
    expect_equal_to_brute_force(walked_costs(30, 26, 2, 0.8, 2.0F, seed), options);
    expect_equal_to_brute_force(chance_costs(20, 9, seed), options);
    options.gaps = {.query = {11}, .reference = {7, 20}};
    expect_equal_to_brute_force(walked_costs(30, 26, 2, 0.8, 2.0F, seed), options);
  }
}

TEST(SearchPath, EqualsBruteForceForAnySteps) {
  vo::Rng rng(5);
  SearchOptions options;
  for (int q = 0; q < 25; ++q) options.path.steps.push_back(std::floor(rng.uniform(0, 24)) / 4);
  options.path.steps[7] = 60;  // past the reference
  expect_equal_to_brute_force(walked_costs(25, 40, 0, 1.5, 2.0F, 6), options);
}

TEST(SearchPath, EqualsBruteForceForAnyRangeAndLength) {
  const auto costs = walked_costs(25, 40, 0, 1.5, 2.0F, 11);
  for (const int length : {1, 3, 40}) {
    expect_equal_to_brute_force(costs, {.sequence = {.length = length, .search_range_rad = 0}});
    expect_equal_to_brute_force(costs, {.sequence = {.length = length, .search_range_rad = 0.7}});
    expect_equal_to_brute_force(costs, {.sequence = {.length = length, .v_min = 1.2, .v_max = 2}});
  }
}

TEST(SearchPath, EqualsBruteForceOverManyChunks) {
  // A chunk of the posterior has 64 references.
  expect_equal_to_brute_force(walked_costs(12, 150, 60, 1, 2.0F, 7), {});
  expect_equal_to_brute_force(walked_costs(12, 129, 122, 1, 2.0F, 8), {});
}

TEST(SearchPath, FindsAWalkThatNoSinglePictureShows) {
  // A true place's cost lies between -4.25 and -0.25, those of 200 others between -2 and 2: of two pictures
  // in five some of them are lower.
  const auto costs = walked_costs(100, 200, 40, 1, 2.25F, 9);
  const auto result = place::search_path(costs, {});
  std::size_t right = 0;
  for (std::size_t q = 0; q < costs.queries; ++q) {
    const std::size_t found = *result.matches[q].reference;
    right += static_cast<std::size_t>(std::max(found, q + 40) - std::min(found, q + 40) <= 2);
  }
  EXPECT_GE(right, 90U);
}

TEST(SearchPath, FollowsTheWalksOwnSteps) {
  // It stands for five queries and then takes four references at a time. Every third picture shows nothing.
  SearchOptions options;
  options.path.steps.assign(20, 0.0);
  std::fill(options.path.steps.begin() + 5, options.path.steps.end(), 4.0);
  auto costs = place::make_cost_matrix(20, 80);
  std::vector<std::size_t> places;
  for (std::size_t q = 0; q < 20; ++q) places.push_back(q < 5 ? 6 : 6 + 4 * (q - 4));
  for (std::size_t q = 0; q < 20; ++q) {
    if (q % 3 != 1) costs.row(q)[places[q]] = -4;
  }
  const auto result = place::search_path(costs, options);
  for (std::size_t q = 0; q < 20; ++q) EXPECT_EQ(result.matches[q].reference, places[q]) << q;
}

TEST(SearchPath, IsUnsureOffTheRoute) {
  // References 40 .. 79 are missing: the walk leaves the route there.
  const auto whole = walked_costs(120, 120, 0, 1, 4.0F, 10);
  auto costs = place::make_cost_matrix(120, 80);
  for (std::size_t q = 0; q < 120; ++q) {
    for (std::size_t r = 0; r < 80; ++r) costs.row(q)[r] = whole.at(q, r < 40 ? r : r + 40);
  }
  const auto result = place::search_path(costs, {});
  for (std::size_t q = 0; q < 120; ++q) {
    const auto score = result.matches[q].score;
    if (q < 38 || q > 82) {
      EXPECT_GT(score, 0) << q;
    }
    if (q > 42 && q < 78) {
      EXPECT_LT(score, 0) << q;
    }
  }
}

TEST(SearchPath, GivesNothingForNothing) {
  EXPECT_THAT(place::search_path(place::make_cost_matrix(0, 5), {}).matches, IsEmpty());
  EXPECT_THAT(place::search_path(place::make_cost_matrix(3, 0), {}).matches,
              Each(Field(&place::SequenceMatch::reference, std::nullopt)));
}

TEST(SearchPath, TakesTheOnlyReference) {
  const auto result = place::search_path(place::make_cost_matrix(1, 1), {});
  EXPECT_EQ(result.matches[0].reference, 0U);
  // An average cost is exp(-1/2) times as probable on the route as off it, which were even before.
  EXPECT_NEAR(result.matches[0].score, -0.5, 1e-5);
}

TEST(SearchPath, IsSureOfNothingWhereAllCostsAreEqual) {
  for (const place::SequenceMatch& match : place::search_path(place::make_cost_matrix(40, 100), {}).matches)
    EXPECT_LT(match.score, 0);
}

TEST(SearchPath, IsTheSameForAnyThreadCount) {
  const auto costs = walked_costs(100, 80, 3, 0.7, 1.0F, 5);
  const SearchOptions options{.gaps = {.query = {30, 62}, .reference = {}}};
  vo::set_thread_count(1);
  const auto one = place::search_path(costs, options).matches;
  vo::set_thread_count(4);
  const auto four = place::search_path(costs, options).matches;
  vo::set_thread_count(0);
  for (std::size_t q = 0; q < one.size(); ++q) EXPECT_TRUE(test_support::same(one[q], four[q])) << q;
}

TEST(PathScores, OfOtherPlacesEqualBruteForce) {
  const auto costs = walked_costs(25, 20, 2, 0.8, 2.0F, 4);
  SearchOptions options;
  options.sequence.uniqueness_window = 2;
  std::vector<place::SequenceMatch> given(costs.queries);
  for (std::size_t q = 0; q < costs.queries; ++q) {
    if (q % 5 != 0) given[q].reference = (7 * q) % costs.references;
  }
  const auto scored = place::path_scores(costs, given, options);
  const auto posteriors = brute_force_posteriors(costs, options);
  ASSERT_EQ(scored.size(), given.size());
  for (std::size_t q = 0; q < costs.queries; ++q) {
    SCOPED_TRACE(q);
    ASSERT_EQ(scored[q].reference, given[q].reference);
    if (!given[q].reference) continue;
    double inside = 0, outside = posteriors[q].back();
    for (std::size_t r = 0; r < costs.references; ++r)
      (std::max(r, *given[q].reference) - std::min(r, *given[q].reference) <= 2 ? inside : outside) +=
          posteriors[q][r];
    EXPECT_NEAR(scored[q].score, std::log(inside / outside), 1e-3);  // as above
  }
}

TEST(PathScores, OfItsOwnMatchesAreTheSearchs) {
  const auto costs = walked_costs(25, 20, 2, 0.8, 2.0F, 4);
  const auto matches = place::search_path(costs, {}).matches;
  const auto scored = place::path_scores(costs, matches, {});
  for (std::size_t q = 0; q < matches.size(); ++q) EXPECT_TRUE(test_support::same(scored[q], matches[q]));
}

TEST(PathScores, RefuseWhatDoesNotFit) {
  const auto costs = place::make_cost_matrix(3, 3);
  std::vector<place::SequenceMatch> given(2);
  EXPECT_THROW(place::path_scores(costs, given, {}), std::invalid_argument);
  given.resize(3);
  given[1].reference = 3;
  EXPECT_THROW(place::path_scores(costs, given, {}), std::invalid_argument);
  EXPECT_THAT(place::path_scores(place::make_cost_matrix(0, 4), {}, {}), IsEmpty());
}

TEST(SearchPath, RefusesOptionsThatAreNotValid) {
  const auto costs = place::make_cost_matrix(3, 3);
  EXPECT_THROW(place::search_path(costs, {.path = {.steps = {1, 1}}}), std::invalid_argument);
  EXPECT_THROW(place::search_path(costs, {.path = {.steps = {1, -1, 1}}}), std::invalid_argument);
  EXPECT_THROW(place::search_path(costs, {.sequence = {.length = 0}}), std::invalid_argument);
}

TEST(SearchPath, CountsARangeBeyondTheSteepestLineAsThat) {
  const auto costs = walked_costs(25, 40, 0, 1.5, 2.0F, 11);
  const auto most = place::search_path(costs, {.sequence = {.search_range_rad = 0.78}});
  for (const double range : {0.79, 0.8}) {
    const auto beyond = place::search_path(costs, {.sequence = {.search_range_rad = range}});
    for (std::size_t q = 0; q < 25; ++q) EXPECT_EQ(beyond.matches[q].score, most.matches[q].score) << range;
  }
}

}  // namespace
