#include "support/drifting_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/trajectory/drift_correction.hpp>

namespace {

using namespace test_support;
using place::correct_drift;
using place::CorrectedWalk;
using place::DriftCorrectionOptions;
using place::DriftStatus;
using place::LoopClosure;
using place::PoseFix;

constexpr double kPi = std::numbers::pi;

Eigen::Matrix2d position_covariance(const place::UncertainPose& pose) {
  Eigen::Matrix2d p;
  p << pose.covariance[0], pose.covariance[1], pose.covariance[3], pose.covariance[4];
  return p;
}

TEST(DriftCorrection, PutsAStraightWalkWhereItsFixesAre) {
  // Ten metres north by odometry; the map has them going east from (100, 50).
  vo::Trajectory odometry;
  std::vector<PoseFix> fixes;
  for (std::size_t i = 0; i <= 10; ++i) {
    const auto m = static_cast<double>(i);
    odometry.push_back({m, {0, m, 0}});
    fixes.push_back({i, {100 + m, 50, kPi / 2}, 3});
  }
  const CorrectedWalk walk = correct_drift(odometry, fixes);
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  ASSERT_EQ(walk.poses.size(), 11U);
  for (std::size_t i = 0; i <= 10; ++i) {
    EXPECT_EQ(walk.poses[i].time_s, odometry[i].time_s);
    // Everything fits, so it is exact but for the solver's tolerance.
    EXPECT_NEAR(walk.poses[i].pose.x_m, 100 + static_cast<double>(i), 1e-3);
    EXPECT_NEAR(walk.poses[i].pose.y_m, 50, 1e-3);
    EXPECT_NEAR(walk.poses[i].pose.heading_rad, kPi / 2, 1e-3);
    EXPECT_NEAR(walk.step_scale[i], 1, 1e-3);
    EXPECT_GT(walk.fix_weight[i], 0.99);
  }
}

TEST(DriftCorrection, KnowsNothingOfWhatWasWalkedInAGap) {
  // The recording pauses while the walker goes on by 40 m and turns: the odometry goes on where it was.
  const vo::Trajectory whole = walk_round_corners(400, 3);
  constexpr std::size_t kGap = 160, kAfter = 240;
  vo::Trajectory truth(whole.begin(), whole.begin() + kGap);
  truth.insert(truth.end(), whole.begin() + kAfter, whole.end());
  vo::Trajectory odometry(whole.begin(), whole.begin() + kGap);
  vo::Pose2 at = odometry.back().pose;
  for (std::size_t i = kGap; i < truth.size(); ++i) {
    // The step from the node before, seen from its heading, put on from where the odometry is.
    if (i > kGap) {
      const vo::Pose2 &a = truth[i - 1].pose, &b = truth[i].pose;
      at = advance(at, distance_m(a, b), vo::wrap_angle_rad(b.heading_rad - a.heading_rad));
    }
    odometry.push_back({truth[i].time_s, at});
  }
  const std::vector<PoseFix> fixes = fixes_of(truth, 4);
  const std::vector<std::size_t> gaps{kGap};
  const CorrectedWalk walk = correct_drift(odometry, fixes, {}, {}, gaps);
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(distance_m(walk.poses[i].pose, truth[i].pose), 0.05) << i;
  EXPECT_THAT(walk.fix_weight, testing::Each(testing::Gt(0.9)));
  // Taken for one walk, what lies on one side of it is torn away, or its matches are let go.
  double worst_m = 0;
  const CorrectedWalk torn = correct_drift(odometry, fixes);
  for (std::size_t i = 0; i < torn.poses.size(); ++i)
    worst_m = std::max(worst_m, distance_m(torn.poses[i].pose, truth[i].pose));
  EXPECT_GT(worst_m, 2);

  // After a gap without a fix beyond it, nobody knows where the walker is.
  std::vector<PoseFix> before;
  for (const PoseFix& fix : fixes)
    if (fix.node < kGap) before.push_back(fix);
  const CorrectedWalk lost = correct_drift(odometry, before, {}, {}, gaps);
  ASSERT_EQ(lost.status, DriftStatus::kCorrected);
  EXPECT_LT(position_covariance(lost.poses[kGap - 1]).trace(), 1);
  EXPECT_GT(position_covariance(lost.poses[kGap]).trace(), 1e5);
  const std::vector<std::size_t> unordered{5, 3};
  EXPECT_THROW(correct_drift(odometry, fixes, {}, {}, unordered), std::invalid_argument);
}

TEST(DriftCorrection, FindsStepLengthAndFieldOfViewThatAreOff) {
  const vo::Trajectory truth = walk_round_corners(400, 3);
  const vo::Trajectory odometry = drifted(truth, {.step_scale = 1.08, .turn_scale = 1.05});
  const CorrectedWalk walk = correct_drift(odometry, fixes_of(truth, 1));
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  EXPECT_GT(distance_m(odometry.back().pose, truth.back().pose), 8);
  // No noise: what is left are the priors' pulls, a few millimetres a metre.
  EXPECT_LT(rmse_m(walk.poses, truth), 0.05);
  for (const double scale : walk.step_scale) EXPECT_NEAR(scale, 1 / 1.08, 0.01);
  for (const double scale : walk.turn_scale) EXPECT_NEAR(scale, 1 / 1.05, 0.02);
}

TEST(DriftCorrection, MovesWithTheMap) {
  const vo::Trajectory truth = walk_round_corners(120, 5);
  const vo::Trajectory odometry = drifted(truth, {.step_scale = 1.1, .turn_noise_rad = 0.02});
  std::vector<PoseFix> fixes = fixes_of(truth, 2, 0.3, 0.2);
  const CorrectedWalk before = correct_drift(odometry, fixes);
  constexpr double kTurn = 2.5;  // clockwise, and then moved
  const auto moved = [&](const vo::Pose2& p) {
    return vo::Pose2{std::cos(kTurn) * p.x_m + std::sin(kTurn) * p.y_m + 1000,
                     std::cos(kTurn) * p.y_m - std::sin(kTurn) * p.x_m - 700,
                     vo::wrap_angle_rad(p.heading_rad + kTurn)};
  };
  for (PoseFix& fix : fixes) fix.pose = moved(fix.pose);
  const CorrectedWalk after = correct_drift(odometry, fixes);
  ASSERT_EQ(after.status, DriftStatus::kCorrected);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // Ceres stops within 1e-8 of the cost, some 1e-4 of a standard deviation.
    EXPECT_LT(distance_m(after.poses[i].pose, moved(before.poses[i].pose)), 1e-3);
    EXPECT_NEAR(position_covariance(after.poses[i]).determinant(),
                position_covariance(before.poses[i]).determinant(), 1e-5);
  }
}

TEST(DriftCorrection, ComesBackFromNinetyDegreesOfHeadingError) {
  const vo::Trajectory truth = walk_round_corners(300, 7);  // 150 m
  for (const double bias : {kPi / 2 / 150, -kPi / 2 / 150}) {
    const vo::Trajectory odometry = drifted(truth, {.bias_rad_per_m = bias, .turn_noise_rad = 0.01});
    // Matches in stretches of 15 m with 15 m between them.
    std::vector<PoseFix> fixes;
    for (const PoseFix& fix : fixes_of(truth, 2, 0.3, 0.1))
      if (fix.node / 30 % 2 == 0) fixes.push_back(fix);
    const CorrectedWalk walk = correct_drift(odometry, fixes);
    ASSERT_EQ(walk.status, DriftStatus::kCorrected);
    EXPECT_LT(rmse_m(walk.poses, truth), 0.5);
  }
}

TEST(DriftCorrection, ComesBackFromTurnsThatWereLost) {
  // Three corners to the right of which odometry sees nothing, in stretches without a match.
  vo::Trajectory truth{{0, {}}}, odometry{{0, {}}};
  std::vector<PoseFix> fixes;
  for (std::size_t i = 1; i < 200; ++i) {
    const bool corner = i % 50 == 0;
    truth.push_back({static_cast<double>(i), advance(truth.back().pose, 0.5, corner ? kPi / 2 : 0)});
    odometry.push_back({static_cast<double>(i), advance(odometry.back().pose, 0.5, 0)});
    if (i % 50 > 10 && i % 50 < 40) fixes.push_back({i, truth.back().pose, 3});
  }
  const CorrectedWalk walk = correct_drift(odometry, fixes);
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  // A turn that nobody saw is taken as an arc over the ten metres without a match, which cuts the corner.
  EXPECT_GT(distance_m(odometry.back().pose, truth.back().pose), 50);
  for (const PoseFix& fix : fixes)
    EXPECT_LT(distance_m(walk.poses[fix.node].pose, fix.pose), 2.5) << fix.node;
}

TEST(DriftCorrection, LetsWrongMatchesGo) {
  const vo::Trajectory truth = walk_round_corners(300, 11);
  const vo::Trajectory odometry =
      drifted(truth, {.step_scale = 1.08, .turn_scale = 1.05, .step_noise_m = 0.05, .turn_noise_rad = 0.02});
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::vector<PoseFix> fixes = fixes_of(truth, 1, 0.3, 0.2, seed);
    const std::vector<bool> wrong = replace_at_random(fixes, truth, 0.3, seed);
    const CorrectedWalk walk = correct_drift(odometry, fixes);
    ASSERT_EQ(walk.status, DriftStatus::kCorrected);
    EXPECT_LT(rmse_m(walk.poses, truth), 0.5);
    for (std::size_t i = 0; i < fixes.size(); ++i) {
      const double off_m = distance_m(fixes[i].pose, truth[fixes[i].node].pose);
      EXPECT_TRUE(off_m <= 5 || walk.fix_weight[i] < 0.1) << i;
      // Half a deviation across and as much again of the estimate leave a match more than half its weight.
      EXPECT_TRUE(wrong[i] || off_m >= DriftCorrectionOptions{}.aside_m / 2 || walk.fix_weight[i] > 0.5) << i;
    }
  }
}

TEST(DriftCorrection, LetsARunOfMatchesToAnotherStreetGo) {
  const vo::Trajectory truth = walk_round_corners(300, 13);
  const vo::Trajectory odometry = drifted(truth, {.step_scale = 1.08, .turn_noise_rad = 0.02});
  std::vector<PoseFix> fixes = fixes_of(truth, 2, 0.2, 0.1);
  // Ten in a row agree with each other, at a place 60 m further on.
  for (std::size_t i = 60; i < 70; ++i) fixes[i].pose = truth[fixes[i].node + 120].pose;
  const CorrectedWalk walk = correct_drift(odometry, fixes);
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  EXPECT_LT(rmse_m(walk.poses, truth), 0.5);
  for (std::size_t i = 60; i < 70; ++i) EXPECT_LT(walk.fix_weight[i], 0.1);
}

TEST(DriftCorrection, RidesOnCorrectedOdometryWhereThereIsNoMatch) {
  const vo::Trajectory truth = walk_round_corners(300, 17);
  const vo::Trajectory odometry = drifted(truth, {.step_scale = 1.08});
  std::vector<PoseFix> fixes;
  for (const PoseFix& fix : fixes_of(truth, 1))
    if (fix.node < 100 || (fix.node >= 180 && fix.node < 260)) fixes.push_back(fix);
  const CorrectedWalk walk = correct_drift(odometry, fixes);
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  EXPECT_LT(rmse_m(walk.poses, truth), 0.1);  // the step length learned before holds in the gap
  const auto sd_m = [&](std::size_t node) {
    return std::sqrt(position_covariance(walk.poses[node]).trace());
  };
  for (std::size_t i = 105; i < 135; ++i) EXPECT_GT(sd_m(i + 1), sd_m(i)) << i;  // grows into the gap,
  EXPECT_GT(sd_m(140), 1.3 * sd_m(50));
  for (std::size_t i = 262; i < 299; ++i)
    EXPECT_GT(sd_m(i + 1), sd_m(i)) << i;  // and without end after the last
  EXPECT_GT(sd_m(299), sd_m(140));
}

TEST(DriftCorrection, CovarianceIsHonestWhereErrorsAreAsTheOptionsSay) {
  DriftCorrectionOptions options;
  options.steady_along_m = options.steady_aside_m = 0;  // none is drawn here
  options.match_correlation_m = 1e-6;                   // nor are errors alike
  options.side_noise_m = options.node_noise_rad = 1e-3;
  options.node_noise_m = 0;
  options.outlier_chi2 = 30;  // and no match is wrong
  const double sd_m = options.match_least_m + options.match_doubtful_m * std::exp(-3 / options.match_score);
  std::size_t inside = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const vo::Trajectory truth = walk_round_corners(160, seed);
    vo::Rng rng(seed);
    const vo::Trajectory odometry = drifted(truth,
                                            {.step_scale = std::exp(options.step_scale_sd * rng.normal()),
                                             .turn_scale = std::exp(options.turn_scale_sd * rng.normal()),
                                             .bias_rad_per_m = options.bias_sd_rad_per_m * rng.normal(),
                                             .step_noise_m = options.step_noise_m,
                                             .turn_noise_rad = options.turn_noise_rad},
                                            seed);
    const CorrectedWalk walk =
        correct_drift(odometry, fixes_of(truth, 4, sd_m, options.aside_m, seed), {}, options);
    ASSERT_EQ(walk.status, DriftStatus::kCorrected);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Eigen::Vector2d e(walk.poses[i].pose.x_m - truth[i].pose.x_m,
                              walk.poses[i].pose.y_m - truth[i].pose.y_m);
      constexpr double kNinety = 4.605;  // of chi-squared with two degrees of freedom
      inside += e.dot(position_covariance(walk.poses[i]).inverse() * e) <= kNinety ? 1 : 0;
      ++all;
    }
  }
  // 30 walks of some 10 independent errors each: a standard deviation of 2 %.
  EXPECT_NEAR(static_cast<double>(inside) / static_cast<double>(all), 0.9, 0.05);
}

TEST(DriftCorrection, BelievesAMatchByItsProbabilityAndSpread) {
  // One fix at the end of a straight walk pulls the more the surer it is, and the sharper.
  vo::Trajectory straight;
  for (int i = 0; i <= 40; ++i) straight.push_back({1.0 * i, {0, 0.5 * i, 0}});
  const auto end_of = [&](double probability, double sd_m) {
    std::vector<PoseFix> fixes;
    for (std::size_t i = 0; i <= 36; i += 4)
      fixes.push_back({.node = i, .pose = straight[i].pose, .score = 3, .probability = 0.999, .sd_m = 0.1});
    vo::Pose2 ahead = straight[40].pose;
    ahead.y_m += 0.5;
    fixes.push_back({.node = 40, .pose = ahead, .score = 3, .probability = probability, .sd_m = sd_m});
    return correct_drift(straight, fixes).poses[40].pose.y_m;
  };
  const double surest = end_of(0.999, 0.1), blunt = end_of(0.999, 1), doubtful = end_of(0.5, 0.1);
  EXPECT_GT(surest, blunt);
  EXPECT_GT(surest, doubtful);
  EXPECT_GT(blunt, 20);
  EXPECT_GT(doubtful, 20);
}

TEST(DriftCorrection, ClosesALoop) {
  // Twice round a square of 20 m; odometry turns too far.
  vo::Trajectory truth{{0, {}}};
  while (truth.size() <= 320)
    truth.push_back(
        {truth.back().time_s + 1, advance(truth.back().pose, 0.5, truth.size() % 40 == 0 ? kPi / 2 : 0)});
  const vo::Trajectory odometry = drifted(truth, {.turn_scale = 1.1, .turn_noise_rad = 0.01});
  std::vector<LoopClosure> loops;
  for (std::size_t i = 165; i <= 320; i += 5) loops.push_back({i, i - 160, 3});
  loops[10].earlier = 5;  // and one wrong
  const CorrectedWalk walk = correct_drift(odometry, {}, loops);
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  // The second round lies upon the first, where odometry is metres off.
  double before_m = 0, after_m = 0;
  for (std::size_t i = 160; i <= 320; ++i) {
    before_m = std::max(before_m, distance_m(odometry[i].pose, odometry[i - 160].pose));
    after_m = std::max(after_m, distance_m(walk.poses[i].pose, walk.poses[i - 160].pose));
  }
  EXPECT_GT(before_m, 8);
  EXPECT_LT(after_m, 0.5);
  EXPECT_LT(walk.loop_weight[10], 0.1);
  EXPECT_LT(distance_m(walk.poses.front().pose, odometry.front().pose), 1e-3);
}

TEST(DriftCorrection, ClosesALoopThatIsFarOffAtFirst) {
  // As above, seen again only at the very end: no smaller gap leads up to it.
  vo::Trajectory truth{{0, {}}};
  while (truth.size() <= 320)
    truth.push_back(
        {truth.back().time_s + 1, advance(truth.back().pose, 0.5, truth.size() % 40 == 0 ? kPi / 2 : 0)});
  const vo::Trajectory odometry = drifted(truth, {.turn_scale = 1.1});
  std::vector<LoopClosure> loops;
  for (std::size_t i = 300; i <= 320; ++i) loops.push_back({i, i - 160, 3});
  const CorrectedWalk walk = correct_drift(odometry, {}, loops);
  EXPECT_GT(distance_m(odometry[310].pose, odometry[150].pose), 6);
  EXPECT_LT(distance_m(walk.poses[310].pose, walk.poses[150].pose), 0.5);
}

TEST(DriftCorrection, StandingStillIsNoWay) {
  vo::Trajectory odometry;
  std::vector<PoseFix> fixes;
  for (std::size_t i = 0; i < 90; ++i) {
    const double y = i < 30 ? static_cast<double>(i) / 3 : i < 60 ? 10 : static_cast<double>(i) / 3 - 10;
    odometry.push_back({static_cast<double>(i), {0, y, 0}});
    fixes.push_back({i, {0, y, 0}, 3});
  }
  const CorrectedWalk walk = correct_drift(odometry, fixes, {}, {.steady_along_m = 0, .steady_aside_m = 0});
  ASSERT_EQ(walk.status, DriftStatus::kCorrected);
  for (std::size_t i = 0; i < 90; ++i) EXPECT_LT(distance_m(walk.poses[i].pose, odometry[i].pose), 0.05);
  // Thirty matches at one place say hardly more than three.
  std::vector<PoseFix> few;
  for (const PoseFix& fix : fixes)
    if (fix.node < 30 || fix.node >= 60 || fix.node % 10 == 0) few.push_back(fix);
  const CorrectedWalk with_few = correct_drift(odometry, few, {}, {.steady_along_m = 0, .steady_aside_m = 0});
  EXPECT_GT(position_covariance(walk.poses[45]).trace(),
            0.8 * position_covariance(with_few.poses[45]).trace());
}

TEST(DriftCorrection, SaysWhenMatchesDoNotAgree) {
  const vo::Trajectory truth = walk_round_corners(60, 19);
  EXPECT_EQ(correct_drift(truth, std::vector<PoseFix>{{5, {}, 3}}).status, DriftStatus::kNoAgreement);
  EXPECT_EQ(correct_drift(truth, std::vector<PoseFix>{{5, {}, 3}, {6, {0, 0.5, 0}, 3}}).status,
            DriftStatus::kNoAgreement);
  // Hundreds of metres apart, in any direction.
  std::vector<PoseFix> fixes;
  vo::Rng rng(1);
  for (std::size_t i = 0; i < 60; i += 3)
    fixes.push_back({i, {1000 * rng.normal(), 1000 * rng.normal(), 3 * rng.normal()}, 3});
  const CorrectedWalk walk = correct_drift(truth, fixes);
  EXPECT_EQ(walk.status, DriftStatus::kNoAgreement);
  EXPECT_TRUE(walk.poses.empty());
}

TEST(DriftCorrection, BetweenNodesOdometryIsCarriedOver) {
  // Nodes at 2, 4 and 6 s of a walk north by a metre a second; the map has them moved east by 0, 0 and 2 m.
  vo::Trajectory odometry;
  for (int i = 0; i <= 8; ++i) odometry.push_back({static_cast<double>(i), {0, static_cast<double>(i), 0}});
  CorrectedWalk walk;
  walk.poses = {{2, {0, 2, 0}}, {4, {0, 4, 0}}, {6, {2, 6, 0}}};
  const std::vector<std::size_t> nodes{2, 4, 6};
  const vo::Trajectory all = place::corrected_between(odometry, nodes, walk);
  ASSERT_EQ(all.size(), 9U);
  const double east_m[] = {0, 0, 0, 0, 0, 1, 2, 2, 2};
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(all[i].time_s, odometry[i].time_s);
    EXPECT_NEAR(all[i].pose.x_m, east_m[i], 1e-12) << i;
    EXPECT_NEAR(all[i].pose.y_m, static_cast<double>(i), 1e-12) << i;
  }
  // A node that is turned as well turns what follows it.
  walk.poses = {{2, {10, 0, kPi / 2}}};
  const vo::Trajectory turned = place::corrected_between(odometry, std::vector<std::size_t>{2}, walk);
  EXPECT_NEAR(turned[5].pose.x_m, 13, 1e-12);
  EXPECT_NEAR(turned[5].pose.y_m, 0, 1e-12);
  EXPECT_NEAR(turned[0].pose.x_m, 8, 1e-12);
  EXPECT_THROW(place::corrected_between(odometry, nodes, walk), std::invalid_argument);
}

TEST(DriftCorrection, NothingAndOneNode) {
  EXPECT_TRUE(correct_drift({}, {}).poses.empty());
  const CorrectedWalk one = correct_drift({{2, {1, 2, 0.5}}}, {});
  ASSERT_EQ(one.poses.size(), 1U);
  EXPECT_NEAR(one.poses[0].pose.x_m, 1, 1e-9);
}

TEST(DriftCorrection, RefusesWhatDoesNotFit) {
  const vo::Trajectory truth = walk_round_corners(10, 1);
  const auto refused = [&](std::vector<PoseFix> fixes, std::vector<LoopClosure> loops,
                           const DriftCorrectionOptions& options = {}) {
    EXPECT_THROW(correct_drift(truth, fixes, loops, options), std::invalid_argument);
  };
  refused({{10, {}, 1}}, {});
  refused({{3, {}, 1}, {3, {}, 1}}, {});
  refused({}, {{4, 4, 1}});
  refused({}, {{10, 4, 1}});
  refused({}, {{5, 4, 1}, {5, 3, 1}});
  refused({}, {}, {.step_noise_m = 0});
  std::string reason;
  EXPECT_FALSE((DriftCorrectionOptions{.steady_along_m = -1}.is_valid(&reason)));
  EXPECT_EQ(reason, "steady_along_m is -1; expected >= 0");
}

TEST(DriftCorrectionOptions, NeedNotSayWhatIsWrong) {
  EXPECT_FALSE((DriftCorrectionOptions{.steady_along_m = -1}.is_valid(nullptr)));
}

}  // namespace
