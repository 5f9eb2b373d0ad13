#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/sequence_search.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::SequenceSearchOptions;
using testing::IsEmpty;

/// Costs in [-2, 2], in multiples of 1/64 so that float sums are exact in any order, of mean 0: the second
/// half of the values is the first with its sign turned. One value is left out of an odd number, as 0.
place::CostMatrix random_costs(std::size_t queries, std::size_t references, std::uint64_t seed) {
  vo::Rng rng(seed);
  place::CostMatrix costs = place::make_cost_matrix(queries, references);
  const std::size_t half = costs.values.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    costs.values[k] = static_cast<float>(static_cast<double>(rng.index(257)) - 128) / 64;
    costs.values[half + k] = -costs.values[k];
  }
  return costs;
}

struct Line {
  double cost = std::numeric_limits<double>::infinity();
  double slope = 1;
  int terms = 0;
};

/// The cheapest line through each reference at one query, by the documented cost, term by term.
std::vector<Line> brute_force_lines(const place::CostMatrix& costs, int query,
                                    const std::vector<double>& slopes, const SequenceSearchOptions& options) {
  const auto references = static_cast<int>(costs.references), queries = static_cast<int>(costs.queries);
  std::vector<Line> best(costs.references);
  for (int r = 0; r < references; ++r) {
    for (const double slope : slopes) {
      double sum = 0;
      int terms = 0;
      for (int k = 0; k < options.length; ++k) {
        const int along = k - options.length / 2;
        const int q = query + along, other = r + static_cast<int>(std::lround(along * slope));
        if (q < 0 || q >= queries || other < 0 || other >= references) continue;
        sum += costs.at(static_cast<std::size_t>(q), static_cast<std::size_t>(other));
        ++terms;
      }
      if (terms == 0 || terms < options.min_fraction * options.length) continue;
      const double cost = sum / std::sqrt(static_cast<double>(terms) * options.length);
      Line& line = best[static_cast<std::size_t>(r)];
      if (cost < line.cost) line = {cost, slope, terms};
    }
  }
  return best;
}

void expect_equal_to_brute_force(const place::CostMatrix& costs, const std::vector<double>& slopes,
                                 const SequenceSearchOptions& options) {
  const auto matches = place::search_sequences(costs, options);
  ASSERT_EQ(matches.size(), costs.queries);
  // The sums are exact; what remains is the rounding of one square root and one division of values below 2.
  constexpr double kRounding = 1e-5;
  for (std::size_t q = 0; q < costs.queries; ++q) {
    SCOPED_TRACE(q);
    const auto lines = brute_force_lines(costs, static_cast<int>(q), slopes, options);
    double cheapest = std::numeric_limits<double>::infinity();
    for (const Line& line : lines) cheapest = std::min(cheapest, line.cost);
    ASSERT_EQ(matches[q].reference.has_value(), std::isfinite(cheapest));
    if (!matches[q].reference) continue;
    const std::size_t r = *matches[q].reference;
    ASSERT_LT(r, costs.references);
    EXPECT_NEAR(matches[q].cost, cheapest, kRounding);
    EXPECT_NEAR(lines[r].cost, cheapest, kRounding);  // the reference named is one of the cheapest
    double elsewhere = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < lines.size(); ++other) {
      const std::size_t apart = other > r ? other - r : r - other;
      if (apart > static_cast<std::size_t>(options.uniqueness_window))
        elsewhere = std::min(elsewhere, lines[other].cost);
    }
    EXPECT_NEAR(matches[q].score, (std::isfinite(elsewhere) ? elsewhere : 0) - cheapest, kRounding);
    EXPECT_EQ(matches[q].terms, lines[r].terms);
  }
}

std::vector<double> slopes_of_range(double range_rad, int count) {
  std::vector<double> slopes;
  for (int i = 0; i < count; ++i)
    slopes.push_back(std::tan(std::numbers::pi / 4 + range_rad * (2.0 * i / (count - 1) - 1)));
  return slopes;
}

/// Costs of 0 but for a line of -1 that passes `reference` at query 0.
place::CostMatrix planted_line(std::size_t queries, std::size_t references, double slope, double reference) {
  place::CostMatrix costs = place::make_cost_matrix(queries, references);
  for (std::size_t q = 0; q < queries; ++q) {
    const long r = std::lround(reference + slope * static_cast<double>(q));
    if (r >= 0 && r < static_cast<long>(references)) costs.row(q)[static_cast<std::size_t>(r)] = -1;
  }
  return costs;
}

TEST(SearchSequences, EqualsTheDocumentedCost) {
  // Odd and even lengths; walks longer and shorter than a sequence; more queries than share a buffer.
  for (const int length : {1, 2, 7, 10}) {
    for (const auto& [queries, references] : {std::pair{40, 33}, {9, 60}, {4, 5}, {30, 3}}) {
      for (const double range_rad : {0.0, 0.4, 0.75}) {
        SCOPED_TRACE(testing::Message() << length << " keyframes, " << queries << " x " << references << ", "
                                        << range_rad << " rad");
        expect_equal_to_brute_force(
            random_costs(static_cast<std::size_t>(queries), static_cast<std::size_t>(references), 1),
            slopes_of_range(range_rad, 7),
            {.length = length, .search_range_rad = range_rad, .slopes = 7, .uniqueness_window = 4});
      }
    }
  }
}

TEST(SearchSequences, EqualsTheDocumentedCostForAnyFraction) {
  for (const double fraction : {0.01, 0.3, 0.55, 1.0}) {
    SCOPED_TRACE(fraction);
    expect_equal_to_brute_force(random_costs(20, 26, 2), slopes_of_range(0.3, 5),
                                {.length = 9,
                                 .search_range_rad = 0.3,
                                 .slopes = 5,
                                 .min_fraction = fraction,
                                 .uniqueness_window = 3});
  }
}

TEST(SearchSequences, EqualsTheDocumentedCostForVelocities) {
  std::vector<double> slopes;
  for (int i = 0; i <= 8; ++i) slopes.push_back(0.6 + i / 10.0);
  expect_equal_to_brute_force(random_costs(30, 40, 3), slopes,
                              {.length = 10, .v_min = 0.6, .v_max = 1.4, .uniqueness_window = 5});
}

TEST(SearchSequences, FindsPlantedLinesOfAnySlope) {
  for (const double slope : {0.5, 0.8, 1.0, 1.25, 2.0}) {
    SCOPED_TRACE(slope);
    // Long enough for the line to stay inside.
    const auto costs = planted_line(60, 150, slope, 12);
    const auto matches =
        place::search_sequences(costs, {.length = 11, .v_min = slope, .v_max = slope, .min_fraction = 1});
    for (std::size_t q = 0; q < 60; ++q) {
      if (q < 5 || q > 54) {
        EXPECT_FALSE(matches[q].reference) << q;  // only whole lines were asked for
        continue;
      }
      ASSERT_TRUE(matches[q].reference) << q;
      // The line's terms are rounded around each query, those planted around query 0: a keyframe at most.
      EXPECT_NEAR(static_cast<double>(*matches[q].reference), 12 + slope * static_cast<double>(q), 1) << q;
      if (slope == 1 || slope == 2) {
        EXPECT_EQ(*matches[q].reference, 12 + static_cast<std::size_t>(slope) * q);
        // Every term is -1, less the mean of the matrix.
        EXPECT_NEAR(matches[q].cost, -1 + 1.0 / 150, 1e-6);
        EXPECT_EQ(matches[q].terms, 11);
      }
    }
  }
}

TEST(SearchSequences, TellsTheSlope) {
  for (const double slope : {0.6, 1.0, 1.6}) {
    SCOPED_TRACE(slope);
    const auto matches = place::search_sequences(planted_line(80, 160, slope, 10),
                                                 {.length = 21, .search_range_rad = 0.4, .slopes = 81});
    for (std::size_t q = 15; q < 65; ++q) {
      ASSERT_TRUE(matches[q].reference);
      // Over 10 keyframes to either side, a line and the planted one, each rounded, are no more than a
      // keyframe apart: slopes within 1 / 10.
      EXPECT_NEAR(matches[q].slope, slope, 0.1 + 1e-9);
    }
  }
}

TEST(SearchSequences, FollowsTheWalkToItsEndsOnPartOfALine) {
  const auto matches =
      place::search_sequences(planted_line(40, 40, 1, 0), {.length = 10, .search_range_rad = 0});
  for (std::size_t q = 0; q < 40; ++q) EXPECT_EQ(matches[q].reference, q) << q;
  // Terms are at -5 .. +4.
  EXPECT_EQ(matches[0].terms, 5);
  EXPECT_EQ(matches[4].terms, 9);
  EXPECT_EQ(matches[5].terms, 10);
  EXPECT_EQ(matches[35].terms, 10);
  EXPECT_EQ(matches[39].terms, 6);
}

TEST(SearchSequences, DoesNotMindAConstantAddedToEveryCost) {
  auto costs = random_costs(20, 30, 4);
  const auto before = place::search_sequences(costs, {.length = 8});
  for (float& value : costs.values) value += 4;
  const auto after = place::search_sequences(costs, {.length = 8});
  for (std::size_t q = 0; q < 20; ++q) {
    EXPECT_EQ(before[q].reference, after[q].reference);
    EXPECT_NEAR(before[q].cost, after[q].cost, 1e-5);  // sums of 8 floats below 8
    EXPECT_NEAR(before[q].score, after[q].score, 1e-5);
  }
}

TEST(SearchSequences, TheScoreIsTheGapToTheBestLineElsewhere) {
  // Length 1, so costs are the values less their mean of 0.
  place::CostMatrix costs{.queries = 1, .references = 6, .values = {-4, -3, 1, -1, 2, 5}};
  const auto score = [&](int window) {
    return place::search_sequences(costs, {.length = 1, .uniqueness_window = window})[0].score;
  };
  EXPECT_FLOAT_EQ(score(0), 1);  // -3 competes with -4
  EXPECT_FLOAT_EQ(score(1), 3);  // -1 does
  EXPECT_FLOAT_EQ(score(2), 3);
  EXPECT_FLOAT_EQ(score(3), 6);  // 2 does
  EXPECT_FLOAT_EQ(score(5), 4);  // nothing does: against the average line, 0
}

TEST(SearchSequences, OfOneElement) {
  const place::CostMatrix costs{.queries = 1, .references = 1, .values = {3}};
  const auto matches = place::search_sequences(costs, {.length = 1});
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].reference, 0U);
  EXPECT_EQ(matches[0].cost, 0);  // it is its own average
  EXPECT_EQ(matches[0].score, 0);
  EXPECT_EQ(matches[0].terms, 1);
  // A tenth of a line of ten is not half of it.
  EXPECT_FALSE(place::search_sequences(costs, {.length = 10})[0].reference);
}

TEST(SearchSequences, OfTooFewKeyframesFindsNothing) {
  const SequenceSearchOptions options{.length = 10, .min_fraction = 0.5};
  for (const auto& match : place::search_sequences(random_costs(4, 50, 5), options)) {
    EXPECT_FALSE(match.reference);
    EXPECT_EQ(match.score, 0);
    EXPECT_EQ(match.terms, 0);
  }
  for (const auto& match : place::search_sequences(random_costs(50, 3, 5), options))
    EXPECT_FALSE(match.reference);
  for (const auto& match : place::search_sequences(random_costs(5, 0, 5), options))
    EXPECT_FALSE(match.reference);
  EXPECT_THAT(place::search_sequences(place::make_cost_matrix(0, 5), options), IsEmpty());
}

TEST(SearchSequences, OfEqualLinesTakesTheFirstReferenceAndIsNotSure) {
  const auto matches = place::search_sequences(place::make_cost_matrix(12, 30), {.length = 4});
  for (const auto& match : matches) {
    EXPECT_EQ(match.cost, 0);
    EXPECT_EQ(match.score, 0);
  }
  // At query 6 a line of slope 1 at reference 0 lies half inside, which is enough.
  EXPECT_EQ(matches[6].reference, 0U);
  auto twice = planted_line(12, 60, 1, 5);
  const auto other = planted_line(12, 60, 1, 35);
  for (std::size_t k = 0; k < twice.values.size(); ++k) twice.values[k] += other.values[k];
  for (std::size_t q = 0; q < 12; ++q) {
    const auto match = place::search_sequences(twice, {.length = 4})[q];
    EXPECT_EQ(match.reference, q + 5) << q;
    EXPECT_EQ(match.score, 0) << q;
  }
}

TEST(SearchSequences, IsTheSameForAnyThreadCount) {
  const auto costs = random_costs(100, 80, 6);
  const SequenceSearchOptions options{.length = 9, .search_range_rad = 0.5};
  vo::set_thread_count(1);
  const auto one = place::search_sequences(costs, options);
  vo::set_thread_count(4);
  const auto four = place::search_sequences(costs, options);
  vo::set_thread_count(0);
  for (std::size_t q = 0; q < 100; ++q) {
    EXPECT_EQ(one[q].reference, four[q].reference);
    EXPECT_EQ(one[q].cost, four[q].cost);
    EXPECT_EQ(one[q].score, four[q].score);
    EXPECT_EQ(one[q].slope, four[q].slope);
    EXPECT_EQ(one[q].terms, four[q].terms);
  }
}

TEST(ScoreByRatio, ByHand) {
  // Best and second cost -2 and -1 over a least of -3: 1 and 2, so that SeqSLAM's uniqueness is 1/2; one that
  // is no surer than another has 0; one without a match keeps what it has.
  std::vector<place::SequenceMatch> matches{
      {.reference = 4, .cost = -2, .score = 1}, {.reference = 4, .cost = -1, .score = 0}, {}};
  place::score_by_ratio(matches, -3);
  EXPECT_EQ(matches[0].score, 0.5F);
  EXPECT_EQ(matches[1].score, 0);
  EXPECT_FALSE(matches[2].reference);
  std::vector<place::SequenceMatch> constant{{.reference = 0, .cost = 0, .score = 0}};
  place::score_by_ratio(constant, 0);
  EXPECT_EQ(constant[0].score, 0);
}

}  // namespace
