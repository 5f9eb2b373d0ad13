#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/sequence_searcher.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::SequenceMatch;
using place::SequenceSearchOptions;

/// Costs in [-2, 2] in multiples of 1/64, which no rounding changes.
place::CostMatrix random_costs(std::size_t queries, std::size_t references, std::uint64_t seed) {
  vo::Rng rng(seed);
  place::CostMatrix costs = place::make_cost_matrix(queries, references);
  for (float& value : costs.values)
    value = static_cast<float>(static_cast<double>(rng.index(257)) - 128) / 64;
  return costs;
}

/// The straightforward loop: every term of every line, in double.
std::vector<SequenceMatch> search_plainly(const place::CostMatrix& costs,
                                          const SequenceSearchOptions& options) {
  const auto lines = place::search_lines(options);
  const auto queries = static_cast<int>(costs.queries), references = static_cast<int>(costs.references);
  std::vector<SequenceMatch> matches(costs.queries);
  for (int q = 0; q < queries; ++q) {
    std::vector<double> least(costs.references, std::numeric_limits<double>::infinity());
    SequenceMatch& match = matches[static_cast<std::size_t>(q)];
    double best = std::numeric_limits<double>::infinity();
    for (int r = 0; r < references; ++r) {
      for (const auto& line : lines) {
        double sum = 0;
        int terms = 0;
        for (int k = 0; k < options.length; ++k) {
          const int row = q + k - options.length / 2, column = r + line.offsets[static_cast<std::size_t>(k)];
          if (row < 0 || row >= queries || column < 0 || column >= references) continue;
          sum += costs.at(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
          ++terms;
        }
        if (terms == 0 || terms < options.min_fraction * options.length) continue;
        const double cost = sum / std::sqrt(static_cast<double>(terms) * options.length);
        least[static_cast<std::size_t>(r)] = std::min(least[static_cast<std::size_t>(r)], cost);
        if (cost < best) {
          best = cost;
          match = {static_cast<std::size_t>(r), line.slope, static_cast<float>(cost), 0, terms};
        }
      }
    }
    if (!match.reference) continue;
    double second = std::numeric_limits<double>::infinity();
    for (int r = 0; r < references; ++r) {
      if (std::abs(r - static_cast<int>(*match.reference)) > options.uniqueness_window)
        second = std::min(second, least[static_cast<std::size_t>(r)]);
    }
    match.score = static_cast<float>((std::isfinite(second) ? second : 0) - best);
  }
  return matches;
}

/// In parts of `part` references, each cut out of the matrix with no more than its margins.
std::vector<SequenceMatch> search_in_parts(const place::CostMatrix& costs,
                                           const SequenceSearchOptions& options, std::size_t part,
                                           const place::CostRange& range = {.centre = 0, .largest = 2}) {
  place::SequenceSearcher searcher(costs.queries, costs.references, range, options);
  for (std::size_t first = 0; first < costs.references; first += part) {
    const std::size_t count = std::min(part, costs.references - first),
                      begin = first - std::min(first, searcher.margin()),
                      past = std::min(costs.references, first + count + searcher.margin());
    std::vector<float> values;
    for (std::size_t q = 0; q < costs.queries; ++q) {
      const auto row = costs.row(q).subspan(begin, past - begin);
      values.insert(values.end(), row.begin(), row.end());
    }
    searcher.push({0, costs.queries, begin, past - begin, values.data(), past - begin}, count);
  }
  return searcher.finish();
}

std::vector<SequenceMatch> search_whole(const place::CostMatrix& costs,
                                        const SequenceSearchOptions& options) {
  return search_in_parts(costs, options, costs.references);
}

void expect_same(const std::vector<SequenceMatch>& found, const std::vector<SequenceMatch>& expected,
                 double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t q = 0; q < found.size(); ++q) {
    SCOPED_TRACE(q);
    EXPECT_EQ(found[q].reference, expected[q].reference);
    EXPECT_EQ(found[q].slope, expected[q].slope);
    EXPECT_EQ(found[q].terms, expected[q].terms);
    EXPECT_NEAR(found[q].cost, expected[q].cost, tolerance);
    EXPECT_NEAR(found[q].score, expected[q].score, tolerance);
  }
}

TEST(SequenceSearcher, EqualsTheStraightforwardLoop) {
  // References over several stretches and chunks, and few; slopes that need several steps; more rows than are
  // taken in at a time; sequences longer than a walk.
  struct Case {
    std::size_t queries, references;
    SequenceSearchOptions options;
  };
  const std::vector<Case> cases{
      {40, 1300, {.length = 10}},
      {150, 70, {.length = 20, .search_range_rad = 0.5}},
      {90, 200, {.length = 50, .search_range_rad = 0.3, .slopes = 9, .uniqueness_window = 40}},
      {30, 610, {.length = 7, .search_range_rad = 0.75, .slopes = 11, .min_fraction = 1}},
      {12, 40, {.length = 60, .search_range_rad = 0.2, .slopes = 5, .min_fraction = 0.05}},
      {70, 33, {.length = 1}},
      {65, 64, {.length = 9, .v_min = 0.3, .v_max = 6, .uniqueness_window = 0}},
      {1, 100, {.length = 3, .min_fraction = 0.1}},
  };
  // Sums are exact; a cost and a score are rounded to floats of up to 4.
  constexpr double kRounding = 2e-6;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(i);
    const auto& [queries, references, options] = cases[i];
    const auto costs = random_costs(queries, references, i);
    expect_same(search_whole(costs, options), search_plainly(costs, options), kRounding);
  }
}

TEST(SequenceSearcher, DoesNotCareHowThePartsAreCut) {
  // Equal costs in several parts too; windows as wide as a part, narrow and none; steep lines that reach far.
  for (const auto& options :
       {SequenceSearchOptions{.length = 16, .search_range_rad = 0.4},
        SequenceSearchOptions{.length = 6, .min_fraction = 0.9, .uniqueness_window = 0},
        SequenceSearchOptions{.length = 1, .uniqueness_window = 32},
        SequenceSearchOptions{.length = 9, .v_min = 0.3, .v_max = 6, .uniqueness_window = 25}}) {
    for (const bool alike : {false, true}) {
      SCOPED_TRACE(testing::Message() << options.length << (alike ? ", alike" : ""));
      auto costs = random_costs(90, 330, 1);
      if (alike)
        for (float& value : costs.values) value = std::round(value);
      const auto plain = search_plainly(costs, options), whole = search_whole(costs, options);
      if (!alike) expect_same(whole, plain, 2e-6);
      for (const std::size_t part : {32, 64, 192, 320})
        expect_same(search_in_parts(costs, options, part), whole, 0);
    }
  }
}

TEST(SequenceSearcher, ScoresAgainstAllThatIsOutsideTheWindow) {
  // Single costs: the best at 100, its rival at some other place, within reach of the window or not, in an
  // earlier part, the same or a later one.
  constexpr std::size_t kReferences = 256, kBest = 100;
  for (const std::size_t rival : {3, 63, 64, 89, 90, 99, 101, 110, 111, 127, 128, 129, 200, 255}) {
    place::CostMatrix costs = place::make_cost_matrix(1, kReferences);
    std::ranges::fill(costs.values, 1.0F);
    costs.values[kBest] = -2;
    costs.values[rival] = -1;
    const bool outside = rival + 10 < kBest || rival > kBest + 10;
    for (const std::size_t part : {32, 64, 128, 256}) {
      const auto found = search_in_parts(costs, {.length = 1, .uniqueness_window = 10}, part);
      EXPECT_EQ(found[0].reference, kBest);
      EXPECT_EQ(found[0].score, outside ? 1 : 3) << rival << " in parts of " << part;
    }
  }
}

TEST(SequenceSearcher, RoundsAsStated) {
  // Normal costs, which are no multiples of the rounding step.
  place::CostMatrix costs = place::make_cost_matrix(100, 300);
  vo::Rng rng(3);
  for (float& value : costs.values) value = static_cast<float>(rng.normal());
  const SequenceSearchOptions options{.length = 20};
  const auto found = search_in_parts(costs, options, 64, {.centre = 0, .largest = 10});
  // 10 * 20 fit 30 bits at 2^-22, so a term is off by 2^-23 and so is the mean of 20, plus a float's
  // rounding; a score is the difference of two.
  expect_same(found, search_plainly(costs, options), 2 * (std::exp2(-23) + 2e-7));
}

TEST(SequenceSearcher, OfNothingFindsNothing) {
  for (const auto& [queries, references] : {std::pair{0, 5}, {5, 0}, {0, 0}}) {
    place::SequenceSearcher searcher(static_cast<std::size_t>(queries), static_cast<std::size_t>(references),
                                     {});
    const auto matches = searcher.finish();
    ASSERT_EQ(matches.size(), static_cast<std::size_t>(queries));
    for (const auto& match : matches) EXPECT_FALSE(match.reference);
  }
}

TEST(SequenceSearcher, WantsPartsInOrderAndAllOfThem) {
  const auto matrix = random_costs(30, 100, 5);
  const place::ConstCosts all = place::block_of(matrix);
  place::SequenceSearcher searcher(30, 100, {.centre = 0, .largest = 2}, {.uniqueness_window = 40});
  const std::size_t margin = searcher.margin();
  ASSERT_GT(margin, 0U);
  EXPECT_THROW(searcher.push(all.columns(0, 64), 64), std::invalid_argument);  // no margin
  EXPECT_THROW(searcher.push(all, 63), std::invalid_argument);                 // an odd part
  EXPECT_THROW(searcher.push(all, 32), std::invalid_argument);                 // less than the window
  EXPECT_THROW(searcher.push(all.columns(64 - margin, 36 + margin), 36), std::invalid_argument);  // too soon
  EXPECT_THROW(searcher.finish(), std::invalid_argument);
  searcher.push(all.columns(0, 64 + margin), 64);
  EXPECT_THROW(searcher.finish(), std::invalid_argument);
  EXPECT_THROW(searcher.push(all, 37), std::invalid_argument);  // more than there are
  EXPECT_THROW(searcher.push({0, 29, 0, 100, all.values, 100}, 36),
               std::invalid_argument);  // not all queries
  searcher.push(all.columns(64 - margin, 36 + margin), 36);
  EXPECT_EQ(searcher.finish().size(), 30U);
  EXPECT_THROW(place::SequenceSearcher(3, 4, {}, {.length = 0}), std::invalid_argument);
}

TEST(SequenceSearcher, IsTheSameForAnyThreadCount) {
  const auto costs = random_costs(80, 2500, 4);
  vo::set_thread_count(1);
  const auto one = search_in_parts(costs, {}, 512);
  vo::set_thread_count(4);
  expect_same(search_in_parts(costs, {}, 512), one, 0);
  vo::set_thread_count(0);
}

}  // namespace
