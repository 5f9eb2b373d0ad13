#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/evaluation/calibration.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::calibration;
using place::ProbableMatch;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Calibration, ComparesWhatWasExpectedWithWhatWasRight) {
  const std::vector<ProbableMatch> matches{
      {0.9, true}, {0.2, false}, {0.8, true}, {0.4, false}, {0.7, false}};
  const auto result = calibration(matches, 2);
  ASSERT_THAT(result.bins, SizeIs(2));  // 0.2 0.4 | 0.7 0.8 0.9
  EXPECT_EQ(result.bins[0].matches, 2U);
  EXPECT_DOUBLE_EQ(result.bins[0].mean, 0.3);
  EXPECT_EQ(result.bins[0].right, 0);
  EXPECT_EQ(result.bins[1].matches, 3U);
  EXPECT_DOUBLE_EQ(result.bins[1].mean, 0.8);
  EXPECT_DOUBLE_EQ(result.bins[1].right, 2 / 3.0);
  EXPECT_EQ(result.bins[1].lowest, 0.7);
  EXPECT_EQ(result.bins[1].highest, 0.9);
  EXPECT_NEAR(result.error, 0.4 * 0.3 + 0.6 * (0.8 - 2 / 3.0), 1e-12);
}

TEST(Calibration, OfProbabilitiesThatHoldIsSmall) {
  vo::Rng rng(1);
  std::vector<ProbableMatch> matches;
  for (int i = 0; i < 10000; ++i) {
    const double probability = rng.uniform();
    matches.push_back({probability, rng.uniform() < probability});
  }
  const auto result = calibration(matches);
  EXPECT_THAT(result.bins, SizeIs(10));
  for (const auto& bin : result.bins) EXPECT_EQ(bin.matches, 1000U);
  // The share of right ones of a thousand is known to a deviation of 0.016 at worst.
  EXPECT_LT(result.error, 0.02);
}

TEST(Calibration, OfAFewHasABinForEach) {
  EXPECT_THAT(calibration({}).bins, IsEmpty());
  EXPECT_EQ(calibration({}).error, 0);
  const auto one = calibration(std::vector<ProbableMatch>{{0.75, true}});
  ASSERT_THAT(one.bins, SizeIs(1));
  EXPECT_DOUBLE_EQ(one.error, 0.25);
}

TEST(Calibration, OfConstantProbabilitiesIsThatOfTheShare) {
  std::vector<ProbableMatch> matches(100, {0.5, false});
  for (std::size_t i = 0; i < 100; i += 2) matches[i].right = true;
  EXPECT_NEAR(calibration(matches).error, 0, 1e-12);
}

TEST(Calibration, RefusesWhatIsNoProbability) {
  EXPECT_THROW(calibration(std::vector<ProbableMatch>{{1.5, true}}), std::invalid_argument);
  EXPECT_THROW(calibration({}, 0), std::invalid_argument);
}

TEST(Calibration, OfEqualProbabilitiesDoesNotDependOnTheirOrder) {
  std::vector<ProbableMatch> matches(100, {0.5, false});
  for (std::size_t i = 0; i < 50; ++i) matches[i].right = true;
  EXPECT_NEAR(calibration(matches).error, 0, 1e-12);
}

}  // namespace
