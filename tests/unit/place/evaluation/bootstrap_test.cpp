#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/evaluation/bootstrap.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::BootstrapOptions;
using place::RunBootstrap;
using place::TimedQueries;

constexpr double kTolerance = 1;

void add(TimedQueries& run, double time_s, double score, bool right) {
  run.time_s.push_back(time_s);
  run.queries.push_back({.score = score, .has_truth = true, .error = right ? 0.0 : 5.0});
}

/// Runs whose queries are right or wrong by whole segments of ten seconds, one query a second.
TimedQueries by_segments(const std::vector<bool>& right) {
  TimedQueries run;
  for (std::size_t s = 0; s < right.size(); ++s) {
    for (int i = 0; i < 10; ++i) add(run, 10.0 * static_cast<double>(s) + i, 0.5, right[s]);
  }
  return run;
}

RunBootstrap bootstrap_one(const TimedQueries& run, const BootstrapOptions& options = {}) {
  return place::bootstrap(std::array{run}, kTolerance, options).front();
}

TEST(Bootstrap, TwoSegmentsGiveTheThreeOutcomesThereAre) {
  // Right, wrong, all of one score: a resample is all right (F1 1), half (F1 0.5: of 20 accepted 10 are
  // right, of 20 with truth 10 found) or all wrong (0), with probabilities 1/4, 1/2, 1/4.
  const RunBootstrap result = bootstrap_one(by_segments({true, false}), {.resamples = 4000});
  std::array<int, 3> count{};
  for (const double f1 : result.max_f1_of) {
    ASSERT_THAT(f1, testing::AnyOf(0.0, 0.5, 1.0));
    ++count[static_cast<std::size_t>(2 * f1)];
  }
  // Five standard deviations of a binomial count: sqrt(4000 / 4 * 3/4) is 27, sqrt(4000 / 4) 32.
  EXPECT_NEAR(count[0], 1000, 137);
  EXPECT_NEAR(count[1], 2000, 158);
  EXPECT_NEAR(count[2], 1000, 137);
  // A quarter lies at either end, so 95 % reach from one to the other.
  EXPECT_EQ(result.max_f1->low, 0);
  EXPECT_EQ(result.max_f1->high, 1);
  // The middle 40 % are all of the middle outcome.
  const RunBootstrap narrow =
      bootstrap_one(by_segments({true, false}), {.resamples = 4000, .confidence = 0.4});
  EXPECT_EQ(narrow.max_f1->low, 0.5);
  EXPECT_EQ(narrow.max_f1->high, 0.5);
}

TEST(Bootstrap, IntervalsAreThoseOfAllPossibleResamples) {
  // Brute force: all 4^4 draws of four segments with 0, 1, 2 and 3 of 3 queries right.
  TimedQueries run;
  for (int segment = 0; segment < 4; ++segment) {
    for (int i = 0; i < 3; ++i) add(run, 10.0 * segment + i, 0.5, i < segment);
  }
  std::vector<double> recalls;
  for (int draw = 0; draw < 256; ++draw) {
    const int right = draw % 4 + draw / 4 % 4 + draw / 16 % 4 + draw / 64;
    recalls.push_back(right / 12.0);
  }
  std::ranges::sort(recalls);
  const RunBootstrap result = bootstrap_one(run, {.resamples = 20000, .confidence = 0.9});
  // 2.0 % of the draws have fewer than 2 right and 5.9 % no more than 2, so the 5 % percentile is 2, further
  // from either than 20000 resamples (sd 0.17 %) could mistake; the other end is its mirror image.
  EXPECT_EQ(result.recall_at_1->low, recalls[12]);
  EXPECT_EQ(result.recall_at_1->high, recalls[243]);
}

TEST(Bootstrap, SegmentsWidenWhatSingleQueriesHide) {
  // 40 segments, each all right or all wrong: 400 queries, but only 40 independent ones. The deviation of the
  // share of right ones is sqrt(10) times that of single draws; the intervals are wider by about as much.
  vo::Rng rng(3);
  std::vector<bool> right;
  for (int i = 0; i < 40; ++i) right.push_back(rng.uniform() < 0.6);
  const TimedQueries run = by_segments(right);
  const auto width = [&](double segment_s) {
    const place::Interval interval = *bootstrap_one(run, {.segment_s = segment_s}).recall_at_1;
    return interval.high - interval.low;
  };
  // Percentiles of 2000 resamples scatter by a few percent.
  EXPECT_NEAR(width(10) / width(1), std::sqrt(10.0), 0.35);
}

TEST(Bootstrap, RunsShareTheirSegments) {
  // The second is wrong in one segment more: in no resample is it better, though the intervals overlap.
  const std::array runs{by_segments({true, true, true, false, true, false}),
                        by_segments({true, true, true, false, false, false})};
  const auto results = place::bootstrap(runs, kTolerance);
  for (std::size_t i = 0; i < results[0].max_f1_of.size(); ++i)
    ASSERT_GE(results[0].max_f1_of[i], results[1].max_f1_of[i]);
  EXPECT_GT(results[1].max_f1->high, results[0].max_f1->low);
  const place::PairedDifference better = place::paired_difference(results[0], results[1]);
  EXPECT_GE(better.interval->low, 0);
  EXPECT_GT(better.interval->high, 0);
  // Equal where the segment is not drawn, (5/6)^6 = 33 % of the resamples, which count half. Five sd of 2000.
  EXPECT_NEAR(better.share_above, 1 - 0.335 / 2, 0.03);
  const place::PairedDifference worse = place::paired_difference(results[1], results[0]);
  EXPECT_DOUBLE_EQ(worse.interval->low, -better.interval->high);
  EXPECT_NEAR(worse.share_above, 1 - better.share_above, 1e-12);
}

TEST(Bootstrap, ARunIsNoBetterThanItself) {
  const auto results = place::bootstrap(std::array{by_segments({true, false, true})}, kTolerance);
  const place::PairedDifference same = place::paired_difference(results[0], results[0]);
  EXPECT_EQ(same.interval->low, 0);
  EXPECT_EQ(same.interval->high, 0);
  EXPECT_EQ(same.share_above, 0.5);
}

TEST(Bootstrap, WhatIsAcceptedOffTheRouteIsWrongInTheResamplesToo) {
  // A segment on the route, all right, and one off it, of one score. Drawn are both: of 20 accepted 10 are
  // right, of 10 with truth 10 found, F1 2/3; the first alone: 1; the second alone: no figures.
  TimedQueries run = by_segments({true});
  for (int i = 0; i < 10; ++i) {
    run.time_s.push_back(10 + i);
    run.queries.push_back({.score = run.queries.front().score, .has_truth = false, .error = {}});
  }
  const RunBootstrap result = bootstrap_one(run, {.resamples = 4000});
  std::array<int, 3> count{};
  for (const double f1 : result.max_f1_of) {
    const std::size_t kind = std::isnan(f1) ? 0 : f1 < 0.9 ? 1 : 2;
    if (kind > 0) {
      ASSERT_DOUBLE_EQ(f1, kind == 1 ? 2.0 / 3 : 1.0);
    }
    ++count[kind];
  }
  EXPECT_NEAR(count[0], 1000, 137);  // as above
  EXPECT_NEAR(count[1], 2000, 158);
  EXPECT_NEAR(count[2], 1000, 137);
}

TEST(Bootstrap, ConstantRunsAreSure) {
  const RunBootstrap result = bootstrap_one(by_segments({true, true, true}));
  for (const auto& interval :
       {result.max_f1, result.auc_pr, result.recall_at_100_precision, result.recall_at_1}) {
    EXPECT_EQ(interval->low, 1);
    EXPECT_EQ(interval->high, 1);
  }
}

TEST(Bootstrap, NothingToDrawGivesNoInterval) {
  EXPECT_TRUE(place::bootstrap({}, kTolerance).empty());
  EXPECT_FALSE(bootstrap_one({}).max_f1);
  EXPECT_FALSE(bootstrap_one(by_segments({true})).max_f1);  // a single segment
  TimedQueries without_truth;
  for (int i = 0; i < 100; ++i) {
    without_truth.time_s.push_back(i);
    without_truth.queries.push_back({.score = 1, .has_truth = false, .error = {}});
  }
  EXPECT_FALSE(bootstrap_one(without_truth).max_f1);
  EXPECT_FALSE(place::paired_difference(bootstrap_one({}), bootstrap_one({})).interval);
}

TEST(Bootstrap, ARunThatMissesTheDrawnSegmentsIsLeftOutOfThatResample) {
  TimedQueries half = by_segments({true, true});  // in two of four segments only
  const auto results =
      place::bootstrap(std::array{by_segments({true, true, false, false}), half}, kTolerance);
  const auto missed = std::ranges::count_if(results[1].max_f1_of, [](double f1) { return std::isnan(f1); });
  // All four draws from the other two: 1 in 16 of 2000, five sd of sqrt(2000 / 16 * 15/16) = 11.
  EXPECT_NEAR(static_cast<double>(missed), 125, 55);
  EXPECT_EQ(results[1].max_f1->low, 1);
}

TEST(Bootstrap, SameSeedSameIntervalsForAnyNumberOfThreads) {
  vo::Rng rng(5);
  TimedQueries run;
  for (int i = 0; i < 300; ++i) add(run, i * 0.5, rng.uniform(), rng.uniform() < 0.7);
  const auto with_threads = [&](int threads, std::uint64_t seed) {
    vo::set_thread_count(threads);
    return bootstrap_one(run, {.resamples = 200, .seed = seed}).max_f1_of;
  };
  const auto one = with_threads(1, 1), four = with_threads(4, 1), other = with_threads(1, 2);
  vo::set_thread_count(0);
  EXPECT_EQ(one, four);
  EXPECT_NE(one, other);
}

TEST(Bootstrap, RefusesWhatIsOutOfRange) {
  const TimedQueries run = by_segments({true, false});
  for (const BootstrapOptions& options :
       {BootstrapOptions{.resamples = 0}, BootstrapOptions{.segment_s = 0}, BootstrapOptions{.confidence = 1},
        BootstrapOptions{.confidence = 0}}) {
    EXPECT_THROW(bootstrap_one(run, options), std::invalid_argument);
  }
  TimedQueries uneven = run;
  uneven.time_s.pop_back();
  EXPECT_THROW(bootstrap_one(uneven), std::invalid_argument);
  EXPECT_THROW(place::paired_difference(bootstrap_one(run), bootstrap_one(run, {.resamples = 7})),
               std::invalid_argument);
}

}  // namespace
