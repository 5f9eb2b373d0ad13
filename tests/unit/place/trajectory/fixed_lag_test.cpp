#include "support/drifting_walk.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/trajectory/fixed_lag.hpp>

namespace {

using namespace test_support;
using place::FixedLagCorrector;
using place::PoseFix;
using place::UncertainPose;

std::vector<UncertainPose> run(const vo::Trajectory& odometry, const std::vector<PoseFix>& fixes,
                               const place::FixedLagOptions& options = {}) {
  FixedLagCorrector corrector(options);
  std::vector<UncertainPose> poses;
  const auto take = [&](const std::vector<UncertainPose>& some) {
    poses.insert(poses.end(), some.begin(), some.end());
  };
  std::size_t next = 0;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const bool seen = next < fixes.size() && fixes[next].node == i;
    take(corrector.push(odometry[i], seen ? std::optional(fixes[next++]) : std::nullopt));
  }
  take(corrector.finish());
  return poses;
}

TEST(FixedLag, IsAsGoodAsTheBatchWithinAFifth) {
  double batch_m = 0, online_m = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const vo::Trajectory truth = walk_round_corners(150, seed);
    const vo::Trajectory odometry = drifted(
        truth, {.step_scale = 1.08, .turn_scale = 1.05, .step_noise_m = 0.08, .turn_noise_rad = 0.03}, seed);
    std::vector<PoseFix> fixes = fixes_of(truth, 2, 0.4, 0.2, seed);
    replace_at_random(fixes, truth, 0.2, seed);
    const std::vector<UncertainPose> poses = run(odometry, fixes, {.lag = 40});
    ASSERT_EQ(poses.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) ASSERT_EQ(poses[i].time_s, truth[i].time_s);
    online_m += rmse_m(poses, truth);
    batch_m += rmse_m(place::correct_drift(odometry, fixes).poses, truth);
  }
  EXPECT_LT(online_m, 1.2 * batch_m);
}

TEST(FixedLag, IsTheBatchWhereTheWindowHoldsTheWalk) {
  const vo::Trajectory truth = walk_round_corners(80, 5);
  const vo::Trajectory odometry = drifted(truth, {.step_scale = 1.08, .turn_noise_rad = 0.02});
  const std::vector<PoseFix> fixes = fixes_of(truth, 1, 0.2, 0.1);
  const std::vector<UncertainPose> poses = run(odometry, fixes, {.lag = 1000});
  const place::CorrectedWalk batch = place::correct_drift(odometry, fixes);
  ASSERT_EQ(poses.size(), 80U);
  // But for the shares of information, which online know only the neighbour before.
  for (std::size_t i = 0; i < 80; ++i) EXPECT_LT(distance_m(poses[i].pose, batch.poses[i].pose), 0.1) << i;
}

TEST(FixedLag, KeepsWhatItLearnedWhenTheWindowHasNoMatchLeft) {
  const vo::Trajectory truth = walk_round_corners(200, 7);
  const vo::Trajectory odometry = drifted(truth, {.step_scale = 1.1, .turn_scale = 0.95});
  std::vector<PoseFix> fixes = fixes_of(truth, 1);
  fixes.resize(100);  // none for the second half: 50 m
  const std::vector<UncertainPose> poses = run(odometry, fixes, {.lag = 20});
  ASSERT_EQ(poses.size(), 200U);
  // Odometry alone would be 5 m off by its steps; the scales stay in the prior, as good as the batch knows
  // them.
  EXPECT_LT(distance_m(poses.back().pose, truth.back().pose), 1.5);
  const place::UncertainPose batch = place::correct_drift(odometry, fixes).poses.back();
  EXPECT_LT(distance_m(poses.back().pose, batch.pose), 0.3);
  EXPECT_GT(poses[199].covariance[0] + poses[199].covariance[4],
            2 * (poses[60].covariance[0] + poses[60].covariance[4]));
}

TEST(FixedLag, TellsWhereTheWalkerIsNow) {
  const vo::Trajectory truth = walk_round_corners(120, 9);
  const vo::Trajectory odometry = drifted(truth, {.step_scale = 1.08});
  const std::vector<PoseFix> fixes = fixes_of(truth, 1);
  FixedLagCorrector corrector({.lag = 30});
  std::size_t final = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    final += corrector.push(odometry[i], i < 10 ? std::nullopt : std::optional(fixes[i])).size();
    const auto now = corrector.latest();
    if (i < 10) {
      EXPECT_FALSE(now);
    } else if (i > 20) {
      ASSERT_TRUE(now);
      EXPECT_EQ(now->time_s, truth[i].time_s);
      EXPECT_LT(distance_m(now->pose, truth[i].pose), 0.3) << i;
      EXPECT_EQ(final, i + 1 > 30 ? i + 1 - 30 : 0);
    }
  }
}

TEST(FixedLag, WithoutAgreementThereIsNoPose) {
  FixedLagCorrector corrector;
  EXPECT_TRUE(corrector.finish().empty());
  const vo::Trajectory truth = walk_round_corners(100, 1);
  EXPECT_TRUE(run(truth, {}).empty());
  EXPECT_TRUE(run(truth, {{5, {0, 0, 0}, 3}, {50, {400, 0, 0}, 3}}).empty());
  EXPECT_THROW(FixedLagCorrector({.lag = 1}), std::invalid_argument);
  EXPECT_THROW(FixedLagCorrector({.drift = {.aside_m = 0}}), std::invalid_argument);
}

}  // namespace
