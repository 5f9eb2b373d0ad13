#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/certainty/match_probability.hpp>
#include <place/evaluation/calibration.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::match_probabilities;
using place::MatchProbabilities;
using place::ProbabilityStatus;
using testing::Each;
using testing::Gt;
using testing::IsEmpty;
using testing::Lt;

struct Drawn {
  std::vector<double> scores, decoys;
  std::vector<bool> right;
};

/// Wrong scores are normal about 0, right ones about `apart`; a share of the walk's is wrong.
Drawn draw(std::size_t count, double wrong_share, double apart, std::uint64_t seed) {
  vo::Rng rng(seed);
  Drawn drawn;
  for (std::size_t i = 0; i < count; ++i) {
    drawn.right.push_back(static_cast<double>(i) >= wrong_share * static_cast<double>(count));
    drawn.scores.push_back(rng.normal() + (drawn.right.back() ? apart : 0));
    drawn.decoys.push_back(rng.normal());
  }
  return drawn;
}

TEST(MatchProbabilities, AreThoseOfTwoNormalGroups) {
  // For normal densities of one deviation the tilt is exact: with 0 and 4 as means, log(f1 / f0) = 4 s - 8.
  const double wrong_share = 0.3;
  const Drawn drawn = draw(4000, wrong_share, 4, 1);
  const MatchProbabilities found = match_probabilities(drawn.scores, drawn.decoys);
  ASSERT_EQ(found.status, ProbabilityStatus::kGiven);
  // Of 4000 some 1200 are wrong and 600 of them below the median: known to a deviation of 2 / sqrt(4000) *
  // 0.4.
  EXPECT_NEAR(found.wrong_share, wrong_share, 0.04);
  for (std::size_t i = 0; i < drawn.scores.size(); ++i) {
    const double odds = (1 - wrong_share) / wrong_share * std::exp(4 * drawn.scores[i] - 8);
    // Between the groups lie 2 % of the scores, some 90, on which the curve rests.
    EXPECT_NEAR(found.probability[i], odds / (1 + odds), 0.15) << drawn.scores[i];
  }
}

TEST(MatchProbabilities, AreCalibratedForAnyShareOfWrongMatches) {
  for (const double wrong_share : {0.05, 0.3, 0.7, 0.95}) {
    const Drawn drawn = draw(1000, wrong_share, 3, 2);
    const MatchProbabilities found = match_probabilities(drawn.scores, drawn.decoys);
    std::vector<place::ProbableMatch> matches;
    for (std::size_t i = 0; i < drawn.scores.size(); ++i)
      matches.push_back({found.probability[i], drawn.right[i]});
    // A bin of 100 right or wrong matches is itself known to 0.05 at worst.
    EXPECT_LE(place::calibration(matches).error, 0.05) << wrong_share;
  }
}

TEST(MatchProbabilities, NeverFallWithTheScore) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Drawn drawn = draw(40, 0.5, 1.5, seed);
    const MatchProbabilities found = match_probabilities(drawn.scores, drawn.decoys);
    std::vector<std::pair<double, double>> pairs;
    for (std::size_t i = 0; i < drawn.scores.size(); ++i)
      pairs.emplace_back(drawn.scores[i], found.probability[i]);
    std::ranges::sort(pairs);
    EXPECT_TRUE(std::ranges::is_sorted(pairs, {}, &std::pair<double, double>::second)) << seed;
  }
}

TEST(MatchProbabilities, DoNotDependOnTheScoresUnit) {
  Drawn drawn = draw(200, 0.4, 3, 5);
  const auto before = match_probabilities(drawn.scores, drawn.decoys).probability;
  for (std::vector<double>* scores : {&drawn.scores, &drawn.decoys}) {
    for (double& s : *scores) s = 1000 * s - 7;
  }
  const auto after = match_probabilities(drawn.scores, drawn.decoys).probability;
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(after[i], before[i], 1e-6) << i;  // the fit stops where nothing changes by more
}

TEST(MatchProbabilities, OfAWalkThatIsNotOnTheRouteAreLow) {
  const Drawn drawn = draw(200, 1, 0, 6);
  EXPECT_THAT(match_probabilities(drawn.scores, drawn.decoys).probability, Each(Lt(0.5)));
}

TEST(MatchProbabilities, OfAShortWalkFarAboveItsDecoysAreHigh) {
  std::vector<double> scores, decoys;
  for (int i = 0; i < 12; ++i) {
    scores.push_back(20 + i);
    decoys.push_back(i % 3);
  }
  const MatchProbabilities found = match_probabilities(scores, decoys);
  EXPECT_THAT(found.probability, Each(Gt(0.95)));
  EXPECT_LT(found.wrong_share, 0.1);
}

TEST(MatchProbabilities, TakeConstantScores) {
  const std::vector<double> same(30, 2.5);
  const MatchProbabilities found = match_probabilities(same, same);
  ASSERT_EQ(found.status, ProbabilityStatus::kGiven);
  for (const double p : found.probability) EXPECT_TRUE(std::isfinite(p));
}

TEST(MatchProbabilities, AreNotGivenForAFew) {
  const std::vector<double> nine(9, 1.0), ten{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  EXPECT_EQ(match_probabilities({}, ten).status, ProbabilityStatus::kFewMatches);
  EXPECT_EQ(match_probabilities(nine, ten).status, ProbabilityStatus::kFewMatches);
  EXPECT_EQ(match_probabilities(ten, nine).status, ProbabilityStatus::kFewDecoys);
  EXPECT_THAT(match_probabilities(ten, nine).probability, IsEmpty());
  EXPECT_EQ(match_probabilities(ten, ten).status, ProbabilityStatus::kGiven);
}

TEST(MatchProbabilities, RefuseWhatIsNoNumber) {
  std::vector<double> scores{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const std::vector<double> decoys = scores;
  EXPECT_THROW(match_probabilities(scores, decoys, {.decoy_quantile = 0}), std::invalid_argument);
  scores[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(match_probabilities(scores, decoys), std::invalid_argument);
}

TEST(MatchProbabilities, DoNotDependOnWhereEqualDecoysLie) {
  const auto surest = [](double at) {
    std::vector<double> scores(20, at);
    scores.insert(scores.end(), 10, at + 0.01);
    return match_probabilities(scores, std::vector<double>(12, at)).probability.back();
  };
  EXPECT_NEAR(surest(0.1), surest(0.25), 1e-6);  // 0.25 adds up exactly
}

}  // namespace
