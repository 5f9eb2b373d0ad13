#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/evaluation/evaluation.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::ScoredQuery;
using testing::IsEmpty;

/// A match with a true place, `error` from it.
ScoredQuery matched(double score, double error) {
  return {.score = score, .has_truth = true, .error = error};
}
ScoredQuery matched_without_truth(double score) {
  return {.score = score, .has_truth = false, .error = std::nullopt};
}
ScoredQuery unmatched(bool has_truth) {
  return {.score = std::nullopt, .has_truth = has_truth, .error = std::nullopt};
}

void expect_point(const place::OperatingPoint& point, double threshold, std::size_t tp, std::size_t fp,
                  std::size_t fn) {
  EXPECT_EQ(point.threshold, threshold);
  EXPECT_EQ(point.true_positives, tp);
  EXPECT_EQ(point.false_positives, fp);
  EXPECT_EQ(point.false_negatives, fn);
}

TEST(Evaluate, WorkedExample) {
  // Six queries with truth, of which one is unmatched; two more without.
  const std::vector<ScoredQuery> queries{matched(0.9, 0.5), matched(0.8, 4.0), matched_without_truth(0.7),
                                         matched(0.6, 9.0), matched(0.5, 1.0), matched(0.2, 7.0),
                                         unmatched(true),   unmatched(false)};
  const place::Evaluation result = place::evaluate(queries, 4);
  EXPECT_EQ(result.queries, 8U);
  EXPECT_EQ(result.with_truth, 6U);
  EXPECT_EQ(result.matched, 6U);
  EXPECT_EQ(result.matched_without_truth, 1U);

  ASSERT_EQ(result.curve.size(), 6U);
  expect_point(result.curve[0], 0.9, 1, 0, 5);
  expect_point(result.curve[1], 0.8, 2, 0, 4);  // an error of the tolerance is right
  expect_point(result.curve[2], 0.7, 2, 1, 4);  // accepted without a true place
  expect_point(result.curve[3], 0.6, 2, 2, 4);  // accepted and wrong: its true place is not found
  expect_point(result.curve[4], 0.5, 3, 2, 3);
  expect_point(result.curve[5], 0.2, 3, 3, 3);  // the unmatched one is missed for good
  EXPECT_DOUBLE_EQ(result.curve[4].precision, 3.0 / 5);
  EXPECT_DOUBLE_EQ(result.curve[4].recall, 3.0 / 6);
  // F1 = 2 TP / (accepted + with truth): 2/7, 4/8, 4/9, 4/10, 6/11, 6/12.
  EXPECT_DOUBLE_EQ(result.best.f1, 6.0 / 11);
  EXPECT_EQ(result.best.threshold, 0.5);
  // 1 * 1/6 + 1 * 1/6 + 3/5 * 1/6.
  EXPECT_DOUBLE_EQ(result.auc_pr, 2.6 / 6);
  EXPECT_DOUBLE_EQ(result.recall_at_100_precision, 2.0 / 6);
  EXPECT_DOUBLE_EQ(result.recall_at_1, 3.0 / 6);
  // Errors 0.5, 1, 4, 7, 9.
  ASSERT_TRUE(result.errors);
  EXPECT_DOUBLE_EQ(result.errors->p50, 4);
  EXPECT_DOUBLE_EQ(result.errors->p75, 7);
  EXPECT_DOUBLE_EQ(result.errors->p90, 7 + 0.6 * 2);
  EXPECT_DOUBLE_EQ(result.errors->max, 9);
}

TEST(Evaluate, EqualScoresAreAcceptedTogether) {
  const std::vector<ScoredQuery> queries{matched(0.5, 0), matched(0.5, 9), matched(0.5, 0), matched(0.1, 0)};
  const place::Evaluation result = place::evaluate(queries, 1);
  ASSERT_EQ(result.curve.size(), 2U);
  expect_point(result.curve[0], 0.5, 2, 1, 2);
  expect_point(result.curve[1], 0.1, 3, 1, 1);
  EXPECT_EQ(result.recall_at_100_precision, 0);
  EXPECT_DOUBLE_EQ(result.auc_pr, 2.0 / 3 * 0.5 + 3.0 / 4 * 0.25);
}

TEST(Evaluate, OfEqualF1TheHighestThresholdIsBest) {
  const std::vector<ScoredQuery> two{matched(0.9, 0), matched_without_truth(0.8), matched_without_truth(0.7),
                                     matched(0.6, 0)};
  // One of one accepted, two with truth: 2 / (1 + 2). Two of four: 4 / (4 + 2).
  const place::Evaluation result = place::evaluate(two, 1);
  EXPECT_DOUBLE_EQ(result.curve[0].f1, result.curve[3].f1);
  EXPECT_EQ(result.best.threshold, 0.9);
}

TEST(Evaluate, EverythingRight) {
  const place::Evaluation result = place::evaluate(std::vector{matched(3, 0), matched(2, 0)}, 0);
  EXPECT_EQ(result.best.f1, 1);
  EXPECT_EQ(result.auc_pr, 1);
  EXPECT_EQ(result.recall_at_100_precision, 1);
  EXPECT_EQ(result.recall_at_1, 1);
}

TEST(Evaluate, EverythingWrong) {
  const place::Evaluation result = place::evaluate(std::vector{matched(3, 9), matched(2, 9)}, 1);
  EXPECT_EQ(result.best.f1, 0);
  EXPECT_EQ(result.best.threshold, 3);
  EXPECT_EQ(result.auc_pr, 0);
  EXPECT_EQ(result.recall_at_100_precision, 0);
  EXPECT_EQ(result.recall_at_1, 0);
  EXPECT_EQ(result.curve.back().precision, 0);
  ASSERT_TRUE(result.errors);
  EXPECT_EQ(result.errors->p99, 9);
}

TEST(Evaluate, NothingMatched) {
  const place::Evaluation result = place::evaluate(std::vector{unmatched(true), unmatched(false)}, 1);
  EXPECT_EQ(result.queries, 2U);
  EXPECT_EQ(result.with_truth, 1U);
  EXPECT_EQ(result.matched, 0U);
  EXPECT_THAT(result.curve, IsEmpty());
  EXPECT_EQ(result.best.f1, 0);
  EXPECT_EQ(result.best.false_negatives, 1U);
  EXPECT_EQ(result.best.precision, 1);
  EXPECT_FALSE(result.errors);
}

TEST(Evaluate, NothingWithTruth) {
  const place::Evaluation result = place::evaluate(std::vector{matched_without_truth(1)}, 1);
  ASSERT_EQ(result.curve.size(), 1U);
  expect_point(result.curve[0], 1, 0, 1, 0);
  EXPECT_EQ(result.curve[0].recall, 0);
  EXPECT_EQ(result.auc_pr, 0);
  EXPECT_EQ(result.recall_at_1, 0);
  EXPECT_FALSE(result.errors);
}

TEST(Evaluate, Nothing) {
  const place::Evaluation result = place::evaluate({}, 1);
  EXPECT_EQ(result.queries, 0U);
  EXPECT_THAT(result.curve, IsEmpty());
  EXPECT_EQ(result.recall_at_1, 0);
  EXPECT_FALSE(result.errors);
}

TEST(Evaluate, OneErrorIsEveryPercentile) {
  const auto errors = place::evaluate(std::vector{matched(1, 2.5)}, 1).errors;
  ASSERT_TRUE(errors);
  for (const double p : {errors->p50, errors->p75, errors->p90, errors->p95, errors->p99, errors->max})
    EXPECT_EQ(p, 2.5);
}

TEST(Evaluate, EqualsBruteForceAtEveryThreshold) {
  vo::Rng rng(1);
  for (int round = 0; round < 100; ++round) {
    SCOPED_TRACE(round);
    std::vector<ScoredQuery> queries(1 + rng.index(40));
    std::set<double, std::greater<>> scores;
    for (ScoredQuery& query : queries) {
      query.has_truth = rng.uniform() < 0.8;
      if (rng.uniform() < 0.2) continue;                 // unmatched
      query.score = static_cast<double>(rng.index(10));  // often equal
      scores.insert(*query.score);
      if (query.has_truth) query.error = rng.uniform(0, 8);
    }
    constexpr double kTolerance = 4;
    const place::Evaluation result = place::evaluate(queries, kTolerance);
    ASSERT_EQ(result.curve.size(), scores.size());
    double best_f1 = 0, auc = 0, recall_before = 0, full_precision = 0;
    auto point = result.curve.begin();
    for (const double threshold : scores) {
      std::size_t tp = 0, fp = 0, fn = 0;
      for (const ScoredQuery& query : queries) {
        const bool accepted = query.score && *query.score >= threshold;
        const bool right = accepted && query.has_truth && *query.error <= kTolerance;
        tp += right ? 1 : 0;
        fp += accepted && !right ? 1 : 0;
        fn += query.has_truth && !right ? 1 : 0;
      }
      expect_point(*point, threshold, tp, fp, fn);
      const auto at = place::operating_point(queries, kTolerance, threshold);
      expect_point(at, threshold, tp, fp, fn);
      EXPECT_EQ(at.f1, point->f1);
      const auto with_truth = static_cast<double>(std::ranges::count_if(queries, &ScoredQuery::has_truth));
      const double precision = static_cast<double>(tp) / static_cast<double>(tp + fp);
      const double recall = with_truth > 0 ? static_cast<double>(tp) / with_truth : 0;
      EXPECT_DOUBLE_EQ(point->precision, precision);
      EXPECT_DOUBLE_EQ(point->recall, recall);
      const double f1 = precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
      EXPECT_NEAR(point->f1, f1, 1e-12);  // two ways of rounding
      best_f1 = std::max(best_f1, f1);
      if (fp == 0) full_precision = std::max(full_precision, recall);
      auc += precision * (recall - recall_before);
      recall_before = recall;
      ++point;
    }
    EXPECT_NEAR(result.best.f1, best_f1, 1e-12);
    EXPECT_NEAR(result.auc_pr, auc, 1e-12);
    EXPECT_DOUBLE_EQ(result.recall_at_100_precision, full_precision);
    EXPECT_EQ(result.recall_at_1, scores.empty() ? 0 : result.curve.back().recall);
  }
}

TEST(Evaluate, DoesNotDependOnTheOrder) {
  std::vector<ScoredQuery> queries{
      matched(0.5, 0), matched(0.5, 9), matched(0.7, 3), unmatched(true), matched_without_truth(0.5),
      matched(0.2, 1)};
  const place::Evaluation before = place::evaluate(queries, 2);
  std::ranges::reverse(queries);
  const place::Evaluation after = place::evaluate(queries, 2);
  ASSERT_EQ(before.curve.size(), after.curve.size());
  for (std::size_t i = 0; i < before.curve.size(); ++i) {
    expect_point(after.curve[i], before.curve[i].threshold, before.curve[i].true_positives,
                 before.curve[i].false_positives, before.curve[i].false_negatives);
  }
  EXPECT_EQ(before.auc_pr, after.auc_pr);
}

TEST(OperatingPoint, WhereNothingIsAcceptedPrecisionIsOne) {
  const auto point = place::operating_point(std::vector{matched(0.5, 0)}, 1, 0.6);
  expect_point(point, 0.6, 0, 0, 1);
  EXPECT_EQ(point.precision, 1);
  EXPECT_EQ(point.recall, 0);
  EXPECT_EQ(point.f1, 0);
  EXPECT_EQ(place::operating_point({}, 1, 0).f1, 0);
}

TEST(Evaluate, RefusesWhatIsNoNumber) {
  EXPECT_THROW(place::evaluate({}, -1), std::invalid_argument);
  EXPECT_THROW(place::evaluate({}, std::nan("")), std::invalid_argument);
  EXPECT_THROW(place::evaluate(std::vector{matched(std::nan(""), 0)}, 1), std::invalid_argument);
  EXPECT_THROW(place::operating_point({}, -1, 0), std::invalid_argument);
  EXPECT_NO_THROW(place::evaluate(std::vector{matched(std::numeric_limits<double>::infinity(), 0)}, 1));
}

}  // namespace
