#include <optional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/evaluation/run_evaluation.hpp>

namespace {

place::Match match(std::int64_t query, std::optional<std::int64_t> reference, double score, bool accepted) {
  place::Match made;
  made.query_frame = query;
  if (reference) made.place.emplace().frame = *reference;
  made.score = score;
  made.accepted = accepted;
  return made;
}

/// Both walks go a metre a frame, the reference for ten frames only.
place::GroundTruth a_metre_a_frame() {
  place::GroundTruth truth;
  for (int i = 0; i < 20; ++i) truth.query_distance_m.push_back(i);
  for (int i = 0; i < 10; ++i) truth.reference_distance_m.push_back(i);
  return truth;
}

TEST(EvaluateRun, CountsByHand) {
  const std::vector<place::Match> matches{match(0, 0, 5, true),              // right
                                          match(3, 4, 4, true),              // a metre off: right
                                          match(5, 9, 3, true),              // wrong
                                          match(7, 7, 2, false),             // right, refused
                                          match(8, std::nullopt, 0, false),  // unmatched
                                          match(15, 9, 1, true)};            // no true place
  const auto run = place::evaluate(matches, a_metre_a_frame(), {.tolerance_m = 1, .tolerance_frames = {}});
  EXPECT_EQ(run.unit, place::ErrorUnit::kMetres);
  ASSERT_EQ(run.errors.size(), 6U);
  EXPECT_EQ(run.errors[1].error, 1);
  EXPECT_EQ(run.errors[2].error, 4);
  EXPECT_FALSE(run.errors[5].has_truth);
  EXPECT_EQ(run.evaluation.with_truth, 5U);
  // As accepted: two right, one wrong and one without a true place; of five with a true place three are not
  // found: the wrong, the refused and the unmatched one.
  EXPECT_EQ(run.accepted.true_positives, 2U);
  EXPECT_EQ(run.accepted.false_positives, 2U);
  EXPECT_EQ(run.accepted.false_negatives, 3U);
  EXPECT_EQ(run.accepted.precision, 0.5);
  EXPECT_EQ(run.accepted.recall, 0.4);
  EXPECT_EQ(run.accepted.threshold, 1);
  // Precision and recall follow from the counts at every threshold.
  for (const auto& p : run.evaluation.curve) {
    EXPECT_EQ(p.true_positives + p.false_negatives, 5U);
    EXPECT_DOUBLE_EQ(p.recall, static_cast<double>(p.true_positives) / 5);
  }
}

TEST(EvaluateRun, InFrames) {
  place::GroundTruth truth;
  truth.pairs = place::LandmarkPairs{{0, 10}, {0, 20}};
  const auto run = place::evaluate(std::vector<place::Match>{match(5, 12, 1, true), match(11, 20, 1, true)},
                                   truth, {.tolerance_m = {}, .tolerance_frames = 2});
  EXPECT_EQ(run.unit, place::ErrorUnit::kFrames);
  EXPECT_EQ(run.errors[0].error, 2);
  EXPECT_FALSE(run.errors[1].has_truth);  // beyond the landmarks
}

TEST(EvaluateRun, WantsOneTolerance) {
  EXPECT_THROW(place::evaluate(std::vector<place::Match>{}, a_metre_a_frame(), {}), std::invalid_argument);
  EXPECT_THROW(place::evaluate(std::vector<place::Match>{}, a_metre_a_frame(),
                               {.tolerance_m = 1, .tolerance_frames = 1}),
               std::invalid_argument);
}

TEST(EvaluateRun, WithNothingAccepted) {
  const auto run = place::evaluate(std::vector<place::Match>{match(1, 1, 1, false)}, a_metre_a_frame(),
                                   {.tolerance_m = 1, .tolerance_frames = {}});
  EXPECT_EQ(run.accepted.precision, 1);
  EXPECT_EQ(run.accepted.recall, 0);
  EXPECT_EQ(run.accepted.false_negatives, 1U);
}

}  // namespace
