#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/evaluation/odometry_evaluation.hpp>
#include <vo/base/rng.hpp>

namespace {

using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;

/// A walk at 1 m/s, a pose each second, along a bow: heading changes by `turn_rad` each metre.
vo::Trajectory bow(std::size_t poses, double turn_rad, double metres_per_s = 1) {
  vo::Trajectory walk{{0, {0, 0, 0}}};
  while (walk.size() < poses) {
    vo::TimedPose next = walk.back();
    next.time_s += 1;
    next.pose.x_m += metres_per_s * std::sin(next.pose.heading_rad);
    next.pose.y_m += metres_per_s * std::cos(next.pose.heading_rad);
    next.pose.heading_rad = vo::wrap_angle_rad(next.pose.heading_rad + turn_rad);
    walk.push_back(next);
  }
  return walk;
}

std::vector<double> metres(std::size_t count) {
  std::vector<double> distance_m(count);
  for (std::size_t i = 0; i < count; ++i) distance_m[i] = static_cast<double>(i);
  return distance_m;
}

/// The whole walk, moved and turned: the same walk in another frame of reference.
vo::Trajectory moved(vo::Trajectory walk, double x_m, double y_m, double turn_rad) {
  for (auto& [time_s, pose] : walk) {
    const auto [x, y, heading] = pose;
    pose = {x_m + x * std::cos(turn_rad) + y * std::sin(turn_rad),
            y_m - x * std::sin(turn_rad) + y * std::cos(turn_rad), vo::wrap_angle_rad(heading + turn_rad)};
  }
  return walk;
}

TEST(PairByTime, LeavesOutStandsAndWhatTheEstimateHasNot) {
  const vo::Trajectory truth = bow(6, 0);
  const std::vector<double> distance_m{0, 1, 1, 1, 2, 3};
  vo::Trajectory estimate{{0.5, {10, 0, 0}}, {4.5, {18, 0, 0.4}}};  // half a second late to a second early
  const auto pairs = place::pair_by_time(truth, distance_m, estimate);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].distance_m, 1);
  EXPECT_DOUBLE_EQ(pairs[0].estimate.x_m, 11);  // at 1 s, an eighth of the way
  EXPECT_DOUBLE_EQ(pairs[0].estimate.heading_rad, 0.05);
  EXPECT_EQ(pairs[0].truth.y_m, 1);
  EXPECT_EQ(pairs[1].distance_m, 2);  // at 4 s
  EXPECT_THAT(place::pair_by_time({}, {}, estimate), IsEmpty());
  EXPECT_THAT(place::pair_by_time(truth, distance_m, {}), IsEmpty());
  EXPECT_THROW(place::pair_by_time(truth, metres(5), estimate), std::invalid_argument);
}

TEST(PairByShare, PutsTheEstimateAlongTheWay) {
  // A true way of 3 m north and 1 m east, with a point drawn twice; an estimate of 8 m straight on, that
  // stands for a while.
  const std::vector<place::MapPoint> way{{0, 0}, {0, 3}, {0, 3}, {1, 3}};
  const vo::Trajectory estimate{
      {0, {0, 0, 0}}, {1, {0, 4, 0}}, {2, {0, 4, 1}}, {3, {0, 7, 0}}, {4, {0, 8, 0}}};
  const auto pairs = place::pair_by_share(way, estimate);
  ASSERT_EQ(pairs.size(), 4U);
  const std::vector<vo::Pose2> truths{{0, 0, 0}, {0, 2, 0}, {0.5, 3, kPi / 2}, {1, 3, kPi / 2}};
  const std::vector<double> distances{0, 2, 3.5, 4};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(pairs[i].distance_m, distances[i]);
    EXPECT_DOUBLE_EQ(pairs[i].truth.x_m, truths[i].x_m);
    EXPECT_DOUBLE_EQ(pairs[i].truth.y_m, truths[i].y_m);
    EXPECT_DOUBLE_EQ(pairs[i].truth.heading_rad, truths[i].heading_rad);
  }
  EXPECT_EQ(pairs[2].estimate.y_m, 7);
  EXPECT_THAT(place::pair_by_share(way, {}), IsEmpty());
  EXPECT_THAT(place::pair_by_share(way, {{0, {0, 0, 0}}, {1, {0, 0, 0}}}), IsEmpty());
  EXPECT_THROW(place::pair_by_share(std::vector<place::MapPoint>{{1, 1}}, estimate), std::invalid_argument);
  EXPECT_THROW(place::pair_by_share(std::vector<place::MapPoint>{{1, 1}, {1, 1}}, estimate),
               std::invalid_argument);
}

TEST(EvaluateOdometry, StepsTooLongByATenth) {
  // On a straight line, the estimate is a tenth further than the truth, wherever the segment begins.
  const auto pairs = place::pair_by_time(bow(301, 0), metres(301), moved(bow(301, 0, 1.1), 5, 6, 1));
  const auto result = place::evaluate_odometry(pairs);
  EXPECT_EQ(result.distance_m, 300);
  EXPECT_EQ(result.segment_m, 100);
  ASSERT_EQ(result.errors.size(), 6U);
  for (const place::OdometryErrors& errors : result.errors) {
    EXPECT_EQ(errors.count, 25U);
    EXPECT_NEAR(errors.euclidean_mean_m, errors.at_m / 10, 1e-9);  // rounding
    EXPECT_NEAR(errors.euclidean_sd_m, 0, 1e-9);
    EXPECT_NEAR(errors.heading_mean_deg, 0, 1e-9);
  }
}

TEST(EvaluateOdometry, DriftToTheLeft) {
  // The truth goes straight on, the estimate turns left by 0.2 degrees a metre: the chord of d metres is at
  // half the turn, and nearly d long.
  const double turn = -0.2 * kPi / 180;
  const auto result = place::evaluate_odometry(place::pair_by_time(bow(251, 0), metres(251), bow(251, turn)));
  for (const place::OdometryErrors& errors : result.errors) {
    EXPECT_NEAR(errors.heading_mean_deg, 0.2 * errors.at_m, 1e-9);  // PVO 5.4: positive; rounding
    EXPECT_NEAR(errors.heading_abs_mean_deg, 0.2 * errors.at_m, 1e-9);
    EXPECT_NEAR(errors.heading_sd_deg, 0, 1e-6);
    // The bow is made of legs of 1 m, and a start within one turns it by up to half of 0.2 degrees.
    EXPECT_NEAR(errors.euclidean_mean_m, errors.at_m * errors.at_m / 2 * -turn,
                0.002 * errors.at_m + 0.01 * errors.euclidean_mean_m);
  }
}

TEST(EvaluateOdometry, DoesNotSeeWhereTheEstimateBegan) {
  vo::Rng rng(8);
  vo::Trajectory estimate = bow(201, 0.01);
  for (vo::TimedPose& pose : estimate) {
    pose.pose.x_m += rng.normal();
    pose.pose.heading_rad = vo::wrap_angle_rad(pose.pose.heading_rad + 0.1 * rng.normal());
  }
  const auto one = place::evaluate_odometry(place::pair_by_time(bow(201, 0), metres(201), estimate));
  const auto other =
      place::evaluate_odometry(place::pair_by_time(bow(201, 0), metres(201), moved(estimate, -40, 7, 2)));
  for (std::size_t i = 0; i < one.errors.size(); ++i) {
    EXPECT_GT(one.errors[i].euclidean_sd_m, 0);
    EXPECT_NEAR(one.errors[i].euclidean_mean_m, other.errors[i].euclidean_mean_m, 1e-9);  // rounding
    EXPECT_NEAR(one.errors[i].heading_sd_deg, other.errors[i].heading_sd_deg, 1e-9);
  }
}

TEST(EvaluateOdometry, AgreesWithAWalkThroughAllSegments) {
  // With very many segments, the mean is that over all starts.
  vo::Trajectory estimate = bow(121, 0);
  for (std::size_t i = 0; i < estimate.size(); ++i)
    estimate[i].pose.x_m = 3 * std::sin(0.1 * static_cast<double>(i));
  const auto pairs = place::pair_by_time(bow(121, 0), metres(121), estimate);
  const auto result = place::evaluate_odometry(pairs, {.segments = 20000, .segment_m = 50, .at_m = {10}});
  double sum = 0;
  for (int i = 0; i < 70; ++i) {  // the middle of each metre
    const double start = i + 0.5;
    const auto x = [&](double at) {
      const auto low = static_cast<std::size_t>(at);
      return std::lerp(estimate[low].pose.x_m, estimate[low + 1].pose.x_m, at - std::floor(at));
    };
    sum += std::abs(x(start + 10) - x(start));
  }
  // Errors up to 6 m deviate by 1.5 m, their mean by 1.5 / sqrt(20000) = 0.011 m; three of that, and the sum
  // for the integral.
  EXPECT_NEAR(result.errors[0].euclidean_mean_m, sum / 70, 0.04);
}

TEST(EvaluateOdometry, KeepsToTheSeedAndToTheWalk) {
  const auto pairs = place::pair_by_time(bow(151, 0), metres(151), bow(151, 0.003));
  const auto mean = [&](std::uint64_t seed) {
    return place::evaluate_odometry(pairs, {.seed = seed}).errors[2].euclidean_mean_m;
  };
  EXPECT_EQ(mean(1), mean(1));
  EXPECT_NE(mean(1), mean(2));
}

TEST(EvaluateOdometry, OnShortWalksMeasuresWhatFits) {
  const auto walk = [](std::size_t poses) {
    return place::pair_by_time(bow(poses, 0), metres(poses), bow(poses, 0));
  };
  const auto on_60_m = place::evaluate_odometry(walk(61));
  EXPECT_EQ(on_60_m.segment_m, 50);
  const std::vector<std::size_t> counts{25, 25, 25, 25, 0, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(on_60_m.errors[i].count, counts[i]);
  for (const auto& pairs : {walk(5), walk(1), std::vector<place::PosePair>{}}) {
    const auto nothing = place::evaluate_odometry(pairs);
    EXPECT_EQ(nothing.segment_m, 0);
    for (const auto& errors : nothing.errors) EXPECT_EQ(errors.count, 0U);
  }
  const auto indoors = place::evaluate_odometry(walk(301), {.segment_m = 50});
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(indoors.errors[i].count, counts[i]);
  const auto one = place::evaluate_odometry(walk(61), {.segments = 1});
  EXPECT_EQ(one.errors[0].count, 1U);
  EXPECT_EQ(one.errors[0].euclidean_sd_m, 0);
}

TEST(EvaluateOdometry, RefusesWhatMakesNoSense) {
  auto pairs = place::pair_by_time(bow(151, 0), metres(151), bow(151, 0));
  EXPECT_THROW(place::evaluate_odometry(pairs, {.at_m = {}}), std::invalid_argument);
  EXPECT_THROW(place::evaluate_odometry(pairs, {.at_m = {5, 5}}), std::invalid_argument);
  EXPECT_THROW(place::evaluate_odometry(pairs, {.at_m = {0, 5}}), std::invalid_argument);
  EXPECT_THROW(place::evaluate_odometry(pairs, {.segment_m = 0}), std::invalid_argument);
  std::swap(pairs[3], pairs[4]);
  EXPECT_THROW(place::evaluate_odometry(pairs), std::invalid_argument);
}

TEST(Pooled, TakesTheMeasurementsOfAllWalksTogether) {
  // By hand: errors of 1 and 3 m on one walk, 5 m on the other, which is too short for 10 m.
  place::OdometryEvaluation one{.distance_m = 30, .segment_m = 10}, other{.distance_m = 8, .segment_m = 5};
  one.errors = {{.at_m = 5, .euclidean_m = {1, 3}, .heading_deg = {-2, 4}},
                {.at_m = 10, .euclidean_m = {2, 2}, .heading_deg = {1, 1}}};
  other.errors = {{.at_m = 5, .euclidean_m = {5}, .heading_deg = {4}}, {.at_m = 10}};
  const place::OdometryEvaluation all = place::pooled(std::vector{one, other});
  EXPECT_EQ(all.distance_m, 38);
  EXPECT_EQ(all.segment_m, 10);
  EXPECT_EQ(all.errors[0].count, 3U);
  EXPECT_DOUBLE_EQ(all.errors[0].euclidean_mean_m, 3);
  EXPECT_DOUBLE_EQ(all.errors[0].euclidean_sd_m, 2);  // sqrt((4 + 0 + 4) / 2)
  EXPECT_DOUBLE_EQ(all.errors[0].heading_mean_deg, 2);
  EXPECT_DOUBLE_EQ(all.errors[0].heading_sd_deg, std::sqrt(12));  // (16 + 4 + 4) / 2
  EXPECT_DOUBLE_EQ(all.errors[0].heading_abs_mean_deg, 10.0 / 3);
  EXPECT_EQ(all.errors[1].count, 2U);
  EXPECT_DOUBLE_EQ(all.errors[1].euclidean_mean_m, 2);
}

TEST(Pooled, OfOneWalkIsThatWalk) {
  const auto walk = place::evaluate_odometry(place::pair_by_time(bow(151, 0), metres(151), bow(151, 0.003)));
  const auto all = place::pooled(std::span(&walk, 1));
  for (std::size_t i = 0; i < walk.errors.size(); ++i) {
    EXPECT_EQ(all.errors[i].count, walk.errors[i].count);
    EXPECT_EQ(all.errors[i].euclidean_sd_m, walk.errors[i].euclidean_sd_m);
    EXPECT_EQ(all.errors[i].heading_mean_deg, walk.errors[i].heading_mean_deg);
  }
  EXPECT_THROW(place::pooled({}), std::invalid_argument);
  auto elsewhere = walk;
  elsewhere.errors.pop_back();
  EXPECT_THROW(place::pooled(std::vector{walk, elsewhere}), std::invalid_argument);
}

TEST(StepErrors, OfSeveralWalks) {
  // By hand: 4 too many of 100, 2 too few of 60, none of 40.
  const auto errors = place::step_errors(std::vector<place::StepCount>{{104, 100}, {58, 60}, {40, 40}});
  EXPECT_DOUBLE_EQ(errors.absolute_mean, 2);
  EXPECT_DOUBLE_EQ(errors.absolute_sd, 2);  // (4 + 0 + 4) / 2 = 2 * 2
  EXPECT_DOUBLE_EQ(errors.mean, 2.0 / 3);
  EXPECT_DOUBLE_EQ(errors.sd, std::sqrt(28.0 / 3));  // squares 20 less 3 * 4/9, over 2
  EXPECT_DOUBLE_EQ(errors.pct, 3);                   // 6 of 200
  const auto one = place::step_errors(std::vector<place::StepCount>{{21, 20}});
  EXPECT_DOUBLE_EQ(one.pct, 5);
  EXPECT_EQ(one.sd, 0);
  EXPECT_EQ(place::step_errors(std::vector<place::StepCount>{{20, 20}}).pct, 0);
  EXPECT_THROW(place::step_errors(std::vector<place::StepCount>{{1, 0}}), std::invalid_argument);
  EXPECT_THROW(place::step_errors({}), std::invalid_argument);
}

}  // namespace
