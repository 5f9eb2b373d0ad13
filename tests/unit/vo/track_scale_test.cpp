#include <cmath>
#include <stdexcept>
#include <support/known_motion.hpp>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/motion/track_scale.hpp>

namespace {

using test_support::known_motion;
using test_support::KnownMotion;

vo::TrackScaleOptions unsmoothed() {
  return {.smoothing_s = 0};
}

TEST(SmoothedDisplacement, LeavesOutBounceAndSway) {
  // Ahead by 0.05 a frame, up and down by 0.04 with each step of 12 frames, aside by as much with each
  // stride.
  vo::DisplacementTrack track;
  std::vector<double> time_s;
  for (int i = 0; i < 200; ++i) {
    const double phase = 2 * 3.14159265 * i / 12;
    time_s.push_back(i / 25.0);
    track.frames.push_back({.valid = i > 0, .displacement = 9, .sigma = 0});
    track.poses.push_back(
        vo::Pose3{.position = {0.04 * std::sin(phase / 2), 0.04 * std::sin(phase), 0.05 * i}});
  }
  const auto smoothed = vo::smoothed_displacement(track, time_s, 1);
  EXPECT_FALSE(smoothed[0].has_value());
  // A second is 25 frames, a frame more than a stride, so a trace of the swing is left: 1/25 of 0.04 * 2 pi
  // / 12.
  for (std::size_t i = 13; i < 187; ++i) EXPECT_NEAR(*smoothed[i], 0.05, 0.001) << i;
  double bouncing = 0;
  const auto raw = vo::smoothed_displacement(track, time_s, 0);
  for (std::size_t i = 13; i < 187; ++i) bouncing += *raw[i] / 174;
  EXPECT_GT(bouncing, 0.052);
}

TEST(SmoothedDisplacement, KeepsSpeedUpToTheEndsOfASegment) {
  vo::DisplacementTrack track;
  std::vector<double> time_s;
  for (int i = 0; i < 100; ++i) {
    const bool lost = i >= 40 && i < 50;
    time_s.push_back(i / 25.0);
    // A frame with a pose is lost too where its segment begins: how far it is from the one before is unknown.
    track.frames.push_back({.valid = i != 0 && !lost && i != 50,
                            .displacement = 0,
                            .sigma = 0,
                            .turn_rad = {},
                            .segment = i < 50 ? 0 : 1});
    track.poses.push_back(lost ? std::nullopt
                               : std::optional(vo::Pose3{.position = {0, 0, i < 40 ? 1.0 * i : 3.0 * i}}));
  }
  const auto smoothed = vo::smoothed_displacement(track, time_s, 1);
  for (std::size_t i = 0; i < 100; ++i) {
    if (i == 0 || (i >= 40 && i <= 50)) {
      EXPECT_FALSE(smoothed[i].has_value()) << i;
    } else {
      EXPECT_NEAR(*smoothed[i], i < 40 ? 1 : 3, 1e-9) << i;  // rounding
    }
  }
}

TEST(TieTrackScale, BringsSegmentsToMetresBySteps) {
  KnownMotion walk = known_motion(40, 1, 1.8);
  for (auto& frame : walk.track.frames) frame.displacement /= 0.2;  // the first unit is 0.2 m
  walk.lose(300, 350, 5);
  walk.lose(600, 640, 0.7);
  vo::MotionEvidence evidence = walk.evidence();
  evidence.steps_m = walk.metres;
  evidence.steps_known.assign(walk.frames(), true);
  const vo::ScaledTrack tied = vo::tie_track_scale(evidence, unsmoothed());
  EXPECT_TRUE(tied.metric);
  for (std::size_t i = 1; i < walk.frames(); ++i) {
    const bool lost = (i >= 300 && i < 350) || (i >= 600 && i < 640);
    ASSERT_EQ(tied.displacement[i].has_value(), !lost) << i;
    if (lost) continue;
    EXPECT_NEAR(*tied.displacement[i], walk.metres[i], 1e-6) << i;  // floats' rounding
  }
}

TEST(TieTrackScale, IsNotMisledByStepsThatWereNotFound) {
  KnownMotion walk = known_motion(40, 1, 1.8);
  vo::MotionEvidence evidence = walk.evidence();
  evidence.steps_m = walk.metres;
  evidence.steps_known.assign(walk.frames(), true);
  for (std::size_t i = 0; i < 40; ++i) evidence.steps_m[i] = 0;     // before the first step found
  for (std::size_t i = 400; i < 430; ++i) evidence.steps_m[i] = 0;  // two in the middle
  const vo::ScaledTrack tied = vo::tie_track_scale(evidence, unsmoothed());
  for (std::size_t i = 1; i < walk.frames(); ++i)
    EXPECT_NEAR(*tied.displacement[i], walk.metres[i], 1e-9) << i;  // rounding
}

TEST(TieTrackScale, FollowsAScaleThatDrifts) {
  KnownMotion walk = known_motion(60, 1, 1.8);
  for (std::size_t i = 0; i < walk.frames(); ++i)
    walk.track.frames[i].displacement *= std::exp(-0.0003 * double(i));
  vo::MotionEvidence evidence = walk.evidence();
  evidence.steps_m = walk.metres;
  evidence.steps_known.assign(walk.frames(), true);
  const vo::ScaledTrack tied = vo::tie_track_scale(evidence, unsmoothed());
  // Within ten seconds the unit changes by 7.5 %, half of it to either side of the frame in the middle.
  for (std::size_t i = 150; i < walk.frames() - 150; ++i)
    EXPECT_NEAR(*tied.displacement[i], walk.metres[i], 0.02 * walk.metres[i]) << i;
}

TEST(TieTrackScale, TiesSegmentsByAlignmentErrorWithoutSteps) {
  KnownMotion walk = known_motion(60, 1, 1.8);
  walk.lose(500, 560, 4);
  walk.lose(900, 930, 0.1);
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), unsmoothed());
  EXPECT_FALSE(tied.metric);
  for (const std::size_t i : {700U, 1200U}) {
    // The relation is exact here but for the bins it is averaged in and the least over five separations.
    EXPECT_NEAR(*tied.displacement[i], walk.metres[i], 0.03 * walk.metres[i]) << i;
  }
}

TEST(TieTrackScale, LeavesOutWhatStepsContradict) {
  KnownMotion walk = known_motion(40, 1, 1.8);
  walk.lose(500, 520, 1);
  for (std::size_t i = 520; i < walk.frames(); ++i)
    walk.track.frames[i].displacement = (i / 50) % 2 == 0 ? 0.2 : 0;  // stop and go, and nothing of the kind
  vo::MotionEvidence evidence = walk.evidence();
  evidence.steps_m = walk.metres;
  evidence.steps_known.assign(walk.frames(), true);
  const vo::ScaledTrack tied = vo::tie_track_scale(evidence, unsmoothed());
  EXPECT_TRUE(tied.displacement[400].has_value());
  for (std::size_t i = 520; i < walk.frames(); ++i) EXPECT_FALSE(tied.displacement[i].has_value()) << i;
}

TEST(TieTrackScale, LeavesOutASegmentTooShort) {
  KnownMotion walk = known_motion(40, 1, 1.8);
  walk.lose(300, 320, 1);
  walk.lose(330, 360, 1);  // ten frames between
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), unsmoothed());
  EXPECT_FALSE(tied.displacement[325].has_value());
  EXPECT_TRUE(tied.displacement[380].has_value());
}

TEST(TieTrackScale, LeavesAMetricTrackAsItIs) {
  KnownMotion walk = known_motion(20, 1, 1.8);
  walk.track.scale = vo::TrackScale::kMetric;
  walk.lose(200, 220, 1);
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), unsmoothed());
  EXPECT_TRUE(tied.metric);
  EXPECT_EQ(*tied.displacement[300], walk.metres[300]);
  EXPECT_FALSE(tied.displacement[210].has_value());
}

TEST(TieTrackScale, RefusesWhatDoesNotFit) {
  KnownMotion walk = known_motion(10, 1, 1.8);
  vo::MotionEvidence evidence = walk.evidence();
  evidence.steps_m.resize(3);
  EXPECT_THROW(vo::tie_track_scale(evidence), std::invalid_argument);
  EXPECT_THROW(vo::tie_track_scale({.time_s = walk.time_s}), std::invalid_argument);
  EXPECT_THROW(vo::tie_track_scale(walk.evidence(), {.steps_window_s = 0}), std::invalid_argument);
}

}  // namespace
