#include "support/rendered_room.hpp"
#include "support/temporary_folder.hpp"

#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/motion/external_trajectory.hpp>

namespace {

using test_support::turned;
using vo::TrackLoss;

/// Two metres a second ahead, turning right by 0.1 rad/s.
vo::PoseSeries series(const std::vector<double>& time_s) {
  vo::PoseSeries poses{.source = "walk.tum", .time_s = time_s};
  for (const double t : time_s) poses.poses.push_back(turned(0.1 * t, {0, 0, 2 * t}));
  return poses;
}

TEST(ExternalTrajectory, InterpolatesBetweenPoses) {
  const auto track =
      vo::external_trajectory(series({10, 10.3, 10.6}), std::vector{0.0, 0.1, 0.25, 0.6}, {.start_s = 10});
  EXPECT_EQ(track.scale, vo::TrackScale::kMetric);
  const std::vector<double> expected_m{0, 0.2, 0.3, 0.7};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(track.frames[i].valid) << i;
    EXPECT_NEAR(track.frames[i].displacement, expected_m[i], 1e-12) << i;
    EXPECT_NEAR(track.frames[i].turn_rad.value(), 0.05 * expected_m[i], 1e-9) << i;
    EXPECT_NEAR(track.frames[i].sigma, 0.02 * expected_m[i], 1e-12);
    EXPECT_EQ(track.frames[i].segment, 0);
  }
}

TEST(ExternalTrajectory, AGapIsALossButEndsNoScale) {
  // Poses to 0.4 s and from 1.4 s; one frame each is within 0.02 s of these.
  const std::vector<double> time_s{0.2, 0.41, 0.6, 1.0, 1.385, 1.5};
  const auto track = vo::external_trajectory(series({0, 0.2, 0.4, 1.4, 1.6}), time_s, {.metric = false});
  EXPECT_EQ(track.scale, vo::TrackScale::kCommon);
  EXPECT_TRUE(track.frames[1].valid);
  EXPECT_NEAR(track.frames[1].displacement, 0.4, 1e-12);  // the pose at 0.4
  for (const std::size_t i : {2, 3, 4}) {
    EXPECT_FALSE(track.frames[i].valid) << i;
    EXPECT_EQ(track.frames[i].loss, TrackLoss::kGap);
  }
  EXPECT_FALSE(track.poses[3]);
  EXPECT_TRUE(track.poses[4]);  // a pose, but no displacement since the frame before
  EXPECT_EQ(track.frames[3].segment, 0);
  EXPECT_EQ(track.frames[4].segment, 1);
  EXPECT_TRUE(track.frames[5].valid);
  EXPECT_EQ(track.frames[5].segment, 1);
}

TEST(ExternalTrajectory, MayBeginLateAndEndEarly) {
  const auto track = vo::external_trajectory(series({1, 1.2}), std::vector{0.0, 0.9, 1.1, 1.2, 1.3});
  const std::vector<bool> valid{false, false, false, true, false};
  for (std::size_t i = 0; i < valid.size(); ++i) EXPECT_EQ(track.frames[i].valid, valid[i]) << i;
  EXPECT_EQ(track.frames[3].segment, 0);
}

TEST(ExternalTrajectory, WithoutTimesHasOnePoseForEachFrame) {
  vo::PoseSeries poses = series({0, 1, 2});
  poses.time_s.clear();
  poses.frame = {0, 1, 2};
  poses.frames = 3;
  const std::vector<double> time_s{0, 0.1, 0.2};
  EXPECT_NEAR(vo::external_trajectory(poses, time_s).frames[2].displacement, 2, 1e-12);
  EXPECT_THROW_WITH(vo::external_trajectory(poses, std::vector{0.0, 0.1}), vo::Error,
                    "walk.tum: has 3 poses without times; expected 2, one for each frame");
  poses.frame = {0, 1, 3};  // a line that was no pose
  poses.frames = 4;
  const auto track = vo::external_trajectory(poses, std::vector{0.0, 0.1, 0.2, 0.3});
  EXPECT_TRUE(track.frames[1].valid);
  EXPECT_FALSE(track.poses[2]);
  EXPECT_FALSE(track.frames[3].valid);
}

TEST(ExternalTrajectory, TurnsAboutTheBodysOwnVertical) {
  vo::PoseSeries poses{.source = "v", .time_s = {0, 1}, .poses = {{}, {}}, .axes = vo::BodyAxes::kVehicle};
  poses.poses[1].rotation = {0, 1, 0, -1, 0, 0, 0, 0, 1};  // x ahead is now what was the right, -y
  const std::vector<double> time_s{0, 1};
  const vo::ExternalTrajectoryOptions slow{.max_gap_s = 2};
  EXPECT_NEAR(vo::external_trajectory(poses, time_s, slow).frames[1].turn_rad.value(), 1.5707963, 1e-6);
  poses.axes = vo::BodyAxes::kNone;
  EXPECT_FALSE(vo::external_trajectory(poses, time_s, slow).frames[1].turn_rad);
}

TEST(ExternalTrajectory, RefusesPosesTooFarApartToTellAnyWay) {
  const std::vector<double> time_s{0, 0.1, 0.2, 1, 2};
  EXPECT_THROW(vo::external_trajectory(series({0, 1, 2}), time_s), vo::Error);
  EXPECT_NO_THROW(vo::external_trajectory(series({0, 1, 2}), time_s, {.max_gap_s = 1}));
  EXPECT_NO_THROW(vo::external_trajectory(series({0}), std::vector{0.0}));  // no way is asked of one frame
}

TEST(ExternalTrajectory, RefusesAnotherClock) {
  EXPECT_THROW_WITH(vo::external_trajectory(series({1000, 1001}), std::vector{0.0, 1.0}), vo::Error,
                    "walk.tum: has poses from 1000 to 1001 s, none at a frame of the walk (0 to 1 s)");
  EXPECT_THROW(vo::external_trajectory(series({0}), std::vector{0.0}, {.max_gap_s = -1}),
               std::invalid_argument);
  EXPECT_EQ(vo::external_trajectory(series({0}), std::vector{0.0}).size(), 1U);
  EXPECT_EQ(vo::external_trajectory(series({0}), {}).size(), 0U);
}

}  // namespace
