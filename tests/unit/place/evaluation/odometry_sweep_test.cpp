#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/evaluation/odometry_sweep.hpp>
#include <vo/base/error.hpp>

namespace {

using testing::SizeIs;

TEST(OdometryImprovement, IsThatOfPvosTable1) {
  // By hand: 10 +- 4 m become 8 +- 5 m; a drift of 6 +- 3 degrees to the right one of 4 +- 2 to the left.
  const place::OdometryErrors base{
      .euclidean_mean_m = 10, .euclidean_sd_m = 4, .heading_mean_deg = -6, .heading_sd_deg = 3};
  const place::OdometryErrors errors{
      .euclidean_mean_m = 8, .euclidean_sd_m = 5, .heading_mean_deg = 4, .heading_sd_deg = 2};
  const place::OdometryImprovement better = place::improvement(errors, base);
  EXPECT_DOUBLE_EQ(better.euclidean_pct, 20);
  EXPECT_DOUBLE_EQ(better.euclidean_sd_pct, -25);
  EXPECT_DOUBLE_EQ(better.heading_deg, -2);
  EXPECT_DOUBLE_EQ(better.heading_sd_deg, -1);
  EXPECT_EQ(place::improvement(errors, {}).euclidean_pct, 0);
}

/// Twenty seconds straight on at 25 frames a second, a step of 0.7 m each half second.
class OdometrySweep : public testing::Test {
 protected:
  OdometrySweep() {
    place::OdometrySweepWalk one{.name = "a walk", .read = [this](const vo::WalkOptions&) {
                                   ++reads_;
                                   return walk_;
                                 }};
    for (int i = 0; i < 500; ++i) {
      const double time_s = i / 25.0, metres = 1.4 * time_s;
      vo::FrameMotion motion;
      if (i > 0) {
        motion.matches = 200;
        motion.orientation_deg = 0.5 * std::sin(2 * std::numbers::pi * time_s);
        motion.shift_px = 0;
        motion.turn = vo::Turn{};
        motion.picture = vo::PictureMotion{.growth = 0.01};
      }
      walk_.time_s.push_back(time_s);
      walk_.tracked.push_back(motion);
      one.truth.time_s.push_back(time_s);
      one.truth.pose.emplace_back(vo::Pose2{0, metres, 0});
      one.truth.distance_m.push_back(metres);
      one.truth.steps.push_back(i == 499 ? 40 : 0);
    }
    walks_ = {one, one};
    settings_.motion = "steps";
    settings_.step_length_model = "fixed";
  }

  vo::Walk walk_;
  std::vector<place::OdometrySweepWalk> walks_;
  place::Settings settings_;
  place::OdometryEvaluationOptions options_{.segment_m = 10, .at_m = {5, 10}};
  int reads_ = 0;
};

TEST_F(OdometrySweep, MeasuresAllWalksWithEveryValue) {
  const auto rows = place::sweep_odometry(walks_, settings_, {"step-length", {"0.7", "0.84"}}, options_);
  EXPECT_EQ(reads_, 2);  // each walk once, as what is read of it does not change
  ASSERT_THAT(rows, SizeIs(2));
  for (const place::OdometrySweepRow& row : rows) {
    EXPECT_EQ(row.steps, 80U);
    ASSERT_TRUE(row.step_errors);
    EXPECT_EQ(row.step_errors->absolute_mean, 0);
    EXPECT_EQ(row.evaluation.errors[1].count, 50U);
    EXPECT_NEAR(row.evaluation.errors[1].heading_mean_deg, 0, 1e-9);
  }
  EXPECT_EQ(rows[1].value, "0.84");
  // Steps a fifth too long; the recording ends within a step, and a start there is off by up to half of one.
  EXPECT_NEAR(rows[1].evaluation.errors[1].euclidean_mean_m - rows[0].evaluation.errors[1].euclidean_mean_m,
              2, 0.2);
}

TEST_F(OdometrySweep, ReadsAWalkAnewForWhatShapesTheReading) {
  const auto rows = place::sweep_odometry(walks_, settings_, {"tracking-window", {"1", "3"}}, options_);
  EXPECT_EQ(reads_, 4);
  EXPECT_EQ(rows[0].evaluation.errors[0].euclidean_m,
            rows[1].evaluation.errors[0].euclidean_m);  // same segments
}

TEST_F(OdometrySweep, RefusesWhatIsNoOdometry) {
  EXPECT_THROW(place::sweep_odometry(walks_, settings_, {"enhance", {"local"}}, options_), vo::Error);
  EXPECT_THROW(place::sweep_odometry(walks_, settings_, {"spacing-m", {"1"}}, options_), vo::Error);
  EXPECT_THROW(place::sweep_odometry(walks_, settings_, {"no-such", {"1"}}, options_), vo::Error);
  options_ = {.segment_m = 50, .at_m = {50}};  // of 28 m
  EXPECT_THROW(place::sweep_odometry(walks_, settings_, {"step-length", {"1"}}, options_), vo::Error);
}

}  // namespace
