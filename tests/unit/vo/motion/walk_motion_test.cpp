#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <support/synthetic_walk.hpp>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/motion/walk_motion.hpp>

namespace {

using test_support::places;
using test_support::Wall;

/// A walk along a wall at speeds that swing between 1 and 3 pixels a frame.
vo::Walk wall_walk() {
  std::vector<double> speed_px;
  for (int i = 0; i < 400; ++i) speed_px.push_back(2 + std::sin(i / 30.0));
  return Wall(1200, 7).walk(places(0, speed_px));
}

/// A track that knows the way in half pixels, and is lost over frames [100, 300).
vo::DisplacementTrack track_of(const vo::Walk& walk) {
  vo::DisplacementTrack track;
  track.scale = vo::TrackScale::kCommon;
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    const bool valid = i > 0 && !(i >= 100 && i < 300);
    track.frames.push_back(
        {.valid = valid, .displacement = 2 * (2 + std::sin((static_cast<double>(i) - 1) / 30)), .sigma = 0});
  }
  return track;
}

TEST(WalkMotion, OfAlignmentErrorIsThatOfVisualMotion) {
  const vo::Walk walk = wall_walk();
  const vo::WalkMotion motion = vo::walk_motion(walk, vo::MotionSource::kSad);
  EXPECT_EQ(vo::displacements(motion), vo::visual_motion(walk).displacement);
  EXPECT_FALSE(motion.metric);
  EXPECT_TRUE(motion.visual.has_value());
  EXPECT_TRUE(motion.trajectory.empty());
  EXPECT_EQ(motion.frames[0].source, vo::DisplacementSource::kNone);
  EXPECT_EQ(motion.frames[9].source, vo::DisplacementSource::kAlignmentError);
  EXPECT_GT(motion.frames[9].sigma, 0);
}

TEST(WalkMotion, OfATrackAloneIsNothingWhereItIsLost) {
  vo::Walk walk = wall_walk();
  walk.track = track_of(walk);
  const vo::WalkMotion motion = vo::walk_motion(walk, vo::MotionSource::kVisualOdometry);
  for (std::size_t i = 100; i < 300; ++i) EXPECT_EQ(motion.frames[i].value, 0);
  EXPECT_EQ(motion.frames[60].value, walk.track->frames[60].displacement);
}

TEST(WalkMotion, AsPublishedATrackIsFilledByAlignmentErrorInItsOwnUnit) {
  vo::Walk walk = wall_walk();
  walk.track = track_of(walk);
  const vo::WalkMotion motion = vo::walk_motion(walk, vo::MotionSource::kHybridAsPublished);
  EXPECT_FALSE(motion.metric);
  EXPECT_TRUE(motion.visual.has_value());
  EXPECT_EQ(motion.frames[60].value, walk.track->frames[60].displacement);
  EXPECT_EQ(motion.frames[200].source, vo::DisplacementSource::kAlignmentError);
  double filled = 0, truly = 0;
  for (std::size_t i = 100; i < 300; ++i) {
    filled += motion.frames[i].value;
    truly += walk.track->frames[i].displacement;
  }
  // Learned from 100 frames of neighbours alone: alignment error is as crude as below.
  EXPECT_NEAR(filled, truly, 0.4 * truly);
}

TEST(WalkMotion, OfAFileIsFilledByAlignmentError) {
  vo::Walk walk = wall_walk();
  walk.track = track_of(walk);
  for (const vo::MotionSource source : {vo::MotionSource::kFile, vo::MotionSource::kHybrid}) {
    const vo::WalkMotion motion = vo::walk_motion(walk, source);
    double filled = 0, truly = 0;
    for (std::size_t i = 100; i < 300; ++i) {
      EXPECT_EQ(motion.frames[i].source, vo::DisplacementSource::kAlignmentError) << i;
      filled += motion.frames[i].value;
      truly += walk.track->frames[i].displacement;
    }
    EXPECT_EQ(motion.frames[60].source, vo::DisplacementSource::kTrack);
    // Alignment error is crude: 0.4 of a second's way is usual, and this wall's texture differs by half from
    // one patch to the next. Without the relation it would be in frames, a quarter of the track's unit.
    EXPECT_NEAR(filled, truly, 0.3 * truly);
  }
}

/// Half a minute at 30 frames a second of a walker of 1.8 steps a second, `speed` times as fast as it was:
/// rings and rays that come nearer for ever, by 15 % a second of the walker's, and bounce by so many pixels
/// of 64.
vo::Walk tunnel_walk(double speed, double bounce_px = 0.4) {
  constexpr int kWidth = 64, kHeight = 32;
  vo::Walk walk;
  walk.source = "tunnel";
  walk.frame_width_px = 640;
  walk.frame_height_px = 320;
  walk.thumbnails = vo::make_image_stack(kWidth, kHeight, 0);
  for (int i = 0; i < 900; ++i) {
    const double at_s = speed * i / 30;
    walk.time_s.push_back(i / 30.0);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double right = x - 31.5,
                     down = y - 15.5 - bounce_px * std::sin(2 * std::numbers::pi * 1.8 * at_s);
        const double depth = std::log(std::hypot(right, down) + 1) - 0.15 * at_s,
                     angle = std::atan2(down, right);
        const double rings =
            std::sin(4 * depth + 2 * angle) + std::sin(7 * depth) + std::sin(5 * depth - 3 * angle);
        walk.thumbnails.pixels.push_back(static_cast<std::uint8_t>(std::lround(128 + 40 * rings)));
      }
    }
  }
  return walk;
}

TEST(WalkMotion, OfAlignmentErrorWarnsOfAClockThatIsNotTheWalkers) {
  const auto warned = [](const vo::Walk& walk) {
    return vo::walk_motion(walk, vo::MotionSource::kSad).warnings;
  };
  EXPECT_THAT(warned(tunnel_walk(1)), testing::IsEmpty());
  EXPECT_THAT(warned(tunnel_walk(0.25)), testing::ElementsAre(testing::HasSubstr("slow motion")));
  EXPECT_THAT(warned(tunnel_walk(3)), testing::ElementsAre(testing::HasSubstr("a time lapse")));
  // What does not bounce shows no steps.
  for (const double speed : {0.25, 1.0, 3.0}) EXPECT_THAT(warned(tunnel_walk(speed, 0)), testing::IsEmpty());
}

TEST(WalkMotion, OfAllWithoutStepsOrTrackIsInFrames) {
  const vo::Walk walk = wall_walk();
  const vo::WalkMotion motion = vo::walk_motion(walk, vo::MotionSource::kHybrid);
  EXPECT_FALSE(motion.metric);
  EXPECT_FALSE(motion.pedestrian.has_value());
  EXPECT_GT(motion.frames[50].value, 0);
}

TEST(WalkMotion, RefusesWhatTheWalkWasNotReadFor) {
  const vo::Walk walk = wall_walk();
  for (const vo::MotionSource source :
       {vo::MotionSource::kNone, vo::MotionSource::kSteps, vo::MotionSource::kVisualOdometry,
        vo::MotionSource::kFile, vo::MotionSource::kHybridAsPublished}) {
    EXPECT_THROW(vo::walk_motion(walk, source), std::invalid_argument) << vo::name_of(source);
  }
  const vo::Walk stand = Wall(200, 7).walk(std::vector<double>(100, 5));
  EXPECT_THROW(vo::walk_motion(stand, vo::MotionSource::kSad), vo::Error);
}

TEST(WalkMotion, OfACameraThatNeverLeavesItsFirstViewIsNone) {
  vo::Walk stand = Wall(200, 7).walk(std::vector<double>(100, 5));
  stand.track.emplace();  // of what seemed to move
  for (std::size_t i = 0; i < stand.frames(); ++i)
    stand.track->frames.push_back({.valid = i > 0, .displacement = 0.1});
  const vo::WalkMotion motion = vo::walk_motion(stand, vo::MotionSource::kHybrid);
  ASSERT_EQ(motion.frames.size(), 100U);
  for (std::size_t i = 1; i < 100; ++i) {
    EXPECT_EQ(motion.frames[i].value, 0);
    EXPECT_EQ(motion.frames[i].source, vo::DisplacementSource::kAlignmentError);
  }
  EXPECT_FALSE(motion.visual);
  // A file is believed.
  stand.track->scale = vo::TrackScale::kMetric;
  EXPECT_NEAR(vo::walk_motion(stand, vo::MotionSource::kFile).frames[50].value, 0.1, 1e-9);
}

TEST(KeepFor, AsksForWhatTheSourceNeeds) {
  vo::WalkOptions options;
  vo::keep_for(vo::MotionSource::kHybrid, options);
  EXPECT_TRUE(options.track_features && options.visual_odometry);
  vo::keep_for(vo::MotionSource::kSteps, options);
  EXPECT_TRUE(options.track_features && !options.visual_odometry);
  vo::keep_for(vo::MotionSource::kVisualOdometry, options);
  EXPECT_TRUE(!options.track_features && options.visual_odometry);
  vo::keep_for(vo::MotionSource::kSad, options);
  EXPECT_TRUE(!options.track_features && !options.visual_odometry);
}

}  // namespace
