#include "support/rendered_room.hpp"

#include <vector>

#include <gtest/gtest.h>

#include <vo/visual_odometry/track_segment.hpp>

namespace {

using test_support::turned;
using vo::AnchoredPose;

TEST(TrackSegment, FramesGoWithTheirKeyframes) {
  // Keyframes at frames 10 and 14, two units apart; meanwhile adjusted to 4 units. Frames in between keep
  // their place by both: the nearer counts more.
  const std::vector<vo::Keyframe> keyframes{{10, {}}, {14, turned(0, {0, 0, 4})}};
  std::vector<vo::SegmentFrame> frames{{.frame = 10, .before = AnchoredPose{0, {}}}};
  for (std::size_t i = 1; i < 4; ++i) {
    const double z = 0.5 * static_cast<double>(i);
    frames.push_back({.frame = 10 + i,
                      .before = AnchoredPose{0, turned(0, {0, 0, z})},
                      .after = AnchoredPose{1, turned(0, {0, 0, z - 2})},
                      .sigma = 0.1});
  }
  frames.push_back({.frame = 14, .before = AnchoredPose{1, {}}});
  frames.push_back({.frame = 15, .before = AnchoredPose{1, turned(0.2, {0, 0, 1})}});
  vo::DisplacementTrack track;
  track.frames.resize(16);
  track.poses.resize(16);
  vo::write_segment(frames, keyframes, 3, track);
  EXPECT_FALSE(track.frames[10].valid);  // how far it is from frame 9 is not known
  EXPECT_EQ(track.frames[10].segment, 3);
  // By the first: 0.5 i; by the second: 4 + 0.5 i - 2; share i / 4: 0.5 i + 2 i / 4 = i.
  for (std::size_t i = 11; i <= 15; ++i) {
    EXPECT_TRUE(track.frames[i].valid);
    EXPECT_EQ(track.frames[i].segment, 3);
    EXPECT_NEAR(track.frames[i].displacement, 1, 1e-12) << i;
    EXPECT_NEAR(track.poses[i]->position[2], static_cast<double>(i - 10), 1e-12);
  }
  EXPECT_EQ(track.frames[12].sigma, 0.1);
  EXPECT_NEAR(track.frames[15].turn_rad.value(), 0.2, 1e-12);  // to the right
}

TEST(TrackSegment, AFrameWithoutAPoseIsLostAndSoIsTheNext) {
  std::vector<vo::SegmentFrame> frames{{.frame = 0, .before = AnchoredPose{0, {}}}, {.frame = 1}};
  frames.push_back({.frame = 2, .before = AnchoredPose{0, turned(0, {0, 0, 1})}});
  frames.push_back({.frame = 3, .before = AnchoredPose{0, turned(0, {0, 0, 2})}});
  vo::DisplacementTrack track;
  track.frames.resize(4);
  track.frames[0].valid = true;  // the first of the walk
  track.poses.resize(4);
  vo::write_segment(frames, {{0, {}}}, 0, track);
  EXPECT_TRUE(track.frames[0].valid);
  EXPECT_FALSE(track.frames[1].valid);
  EXPECT_EQ(track.frames[1].loss, vo::TrackLoss::kTooFewInliers);
  EXPECT_FALSE(track.frames[2].valid);
  EXPECT_TRUE(track.poses[2]);
  EXPECT_TRUE(track.frames[3].valid);
  vo::write_segment({}, {}, 1, track);
}

TEST(TrackSegment, LossesHaveNames) {
  EXPECT_EQ(vo::name_of(vo::TrackLoss::kNone), "none");
  EXPECT_EQ(vo::name_of(vo::TrackLoss::kTooFewCorners), "too_few_corners");
  EXPECT_EQ(vo::name_of(vo::TrackLoss::kGap), "gap");
}

}  // namespace
