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

TEST(TieTrackScale, ASegmentIsOneUnitOverFramesThatWereLost) {
  KnownMotion walk = known_motion(40, 1, 1.8);
  for (auto& frame : walk.track.frames) frame.displacement /= 0.2;
  for (const std::size_t begin :
       {300U, 340U, 345U}) {  // the runs between are shorter than any segment may be
    for (std::size_t i = begin; i < begin + 3; ++i) walk.track.frames[i].valid = false;
  }
  vo::MotionEvidence evidence = walk.evidence();
  const vo::ScaledTrack unscaled = vo::tie_track_scale(evidence, unsmoothed());
  evidence.steps_m = walk.metres;
  evidence.steps_known.assign(walk.frames(), true);
  const vo::ScaledTrack in_metres = vo::tie_track_scale(evidence, unsmoothed());
  for (std::size_t i = 1; i < walk.frames(); ++i) {
    ASSERT_EQ(in_metres.displacement[i].has_value(), walk.track.frames[i].valid) << i;
    ASSERT_EQ(unscaled.displacement[i].has_value(), walk.track.frames[i].valid) << i;
    if (!in_metres.displacement[i]) continue;
    EXPECT_NEAR(*in_metres.displacement[i], walk.metres[i], 1e-9) << i;  // rounding
    EXPECT_NEAR(*unscaled.displacement[i], 5 * walk.metres[i], 1e-9) << i;
  }
}

TEST(TieTrackScale, LeavesOutATurnBetweenTwoLosses) {
  KnownMotion walk = known_motion(40, 1, 1.8);
  walk.lose(300, 350, 5);
  double z = 0;
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    vo::TrackedDisplacement& frame = walk.track.frames[i];
    if (i >= 310 && i < 325) frame = {.valid = true, .displacement = 0};  // it has no pose in any scene
    z += frame.displacement;
    walk.track.poses.push_back(i >= 300 && i < 349 ? std::nullopt
                                                   : std::optional(vo::Pose3{.position = {0, 0, z}}));
  }
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), unsmoothed());
  for (std::size_t i = 310; i < 325; ++i) EXPECT_FALSE(tied.displacement[i].has_value()) << i;
  EXPECT_TRUE(tied.displacement[299].has_value());
  EXPECT_TRUE(tied.displacement[360].has_value());
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

TEST(TieTrackScale, TiesSegmentsByAlignmentErrorWithoutStepsOrGround) {
  KnownMotion walk = known_motion(60, 1, 1.8);
  walk.lose(500, 560, 4);
  walk.lose(900, 930, 0.1);
  vo::TrackScaleOptions options = unsmoothed();
  options.tie.relation_sigma = 0.001;  // there is but one scene, and speed swings
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), options);
  EXPECT_FALSE(tied.metric);
  EXPECT_FALSE(tied.by_ground);
  for (const std::size_t i : {700U, 1200U}) {
    // The relation is exact here but for the bins it is averaged in and the least over five separations.
    EXPECT_NEAR(*tied.displacement[i], walk.metres[i], 0.03 * walk.metres[i]) << i;
  }
}

/// Of a camera 1.6 m above the ground, every fifth frame; in the unit of each segment.
void see_ground(KnownMotion& walk) {
  walk.track.heights.resize(walk.frames());
  for (std::size_t i = 5; i < walk.frames(); i += 5) {
    const double metres_per_unit = walk.metres[i] / walk.track.frames[i].displacement;
    walk.track.heights[i] = {1.6 / metres_per_unit, 0.3 / metres_per_unit, 1.61 / metres_per_unit};
  }
}

TEST(TieTrackScale, TiesSegmentsByTheGroundWithoutSteps) {
  KnownMotion walk = known_motion(60, 1, 1.8);
  walk.lose(500, 560, 4);
  walk.lose(900, 930, 0.1);
  see_ground(walk);
  // Another scene, of twice the contrast: alignment error would be wrong by as much.
  for (auto& errors : walk.errors.by_span)
    for (std::size_t i = 560; i < errors.size(); ++i) errors[i].error *= 2;
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), unsmoothed());
  EXPECT_FALSE(tied.metric);
  EXPECT_TRUE(tied.by_ground);
  const double unit = *tied.displacement[300] / walk.metres[300];
  for (const std::size_t i : {100U, 700U, 1200U})
    EXPECT_NEAR(*tied.displacement[i], unit * walk.metres[i], 1e-9) << i;  // rounding

  vo::TrackScaleOptions with_height = unsmoothed();
  with_height.camera_height_m = 1.605;  // where the two heights of each frame meet
  const vo::ScaledTrack in_metres = vo::tie_track_scale(walk.evidence(), with_height);
  EXPECT_TRUE(in_metres.metric);
  for (const std::size_t i : {100U, 700U, 1200U})
    EXPECT_NEAR(*in_metres.displacement[i], walk.metres[i], 1e-4 * walk.metres[i]) << i;
}

TEST(TieTrackScale, HoldsAScaleThatDriftsByTheGround) {
  KnownMotion walk = known_motion(60, 1, 1.8);
  for (std::size_t i = 0; i < walk.frames(); ++i)
    walk.track.frames[i].displacement *= std::exp(-0.0003 * double(i));
  see_ground(walk);
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), unsmoothed());
  const double unit = *tied.displacement[750] / walk.metres[750];
  // In the ten seconds to either side of a frame the unit changes by 7.5 %; at the ends, where there is but
  // one side, half of that is left, and at both ends it is to another side.
  for (std::size_t i = 1; i < walk.frames(); ++i)
    EXPECT_NEAR(*tied.displacement[i], unit * walk.metres[i], 0.05 * unit * walk.metres[i]) << i;
}

TEST(TieTrackScale, TiesASegmentWithoutGroundBySpeedAndAlignmentError) {
  KnownMotion walk = known_motion(60, 1, 1.8);
  walk.lose(500, 560, 4);
  walk.lose(900, 930, 0.1);
  see_ground(walk);
  for (std::size_t i = 560; i < 900; ++i) walk.track.heights[i].clear();
  const vo::ScaledTrack tied = vo::tie_track_scale(walk.evidence(), unsmoothed());
  const double unit = *tied.displacement[300] / walk.metres[300];
  const double tie = *tied.displacement[700] / walk.metres[700] / unit;
  EXPECT_GT(tie, 0.7);  // as speed changes over 3.4 s of a swing of 9 s
  EXPECT_LT(tie, 1.4);
  // The ground is that before the loss, however the segment between was tied.
  EXPECT_NEAR(*tied.displacement[1200], unit * walk.metres[1200], 1e-9);
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
