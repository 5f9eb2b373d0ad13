#include "support/rendered_room.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/visual_odometry/landmark_tracking.hpp>
#include <vo/visual_odometry/scene_tracking.hpp>

namespace {

using test_support::RenderedRoom;
using test_support::turned;
using vo::TrackLoss;

vo::Camera camera() {
  return vo::camera_from_fov(320, 200, 70);
}

vo::SceneTrackingOptions options() {
  const double noise = 0.5 / camera().fx_px;
  return {.map = {.noise = noise}, .pose = {.noise = noise}};
}

cv::Mat view(double z_m) {
  static const RenderedRoom room;
  return room.view(camera(), turned(0, {0, 0, z_m}));
}

/// Of two keyframes 0.3 m apart, with the landmarks placed from them.
vo::TrackedScene scene() {
  vo::TrackedScene scene;
  scene.map.keyframes.push_back({0, {}});
  vo::add_corners(scene.map, view(0), camera());
  vo::follow_landmarks(scene.map, vo::klt_pyramid(view(0)), vo::klt_pyramid(view(0.3)), camera(),
                       std::nullopt);
  scene.pose = turned(0, {0, 0, 0.3});
  scene.motion = turned(0, {0, 0, 0.1});
  vo::add_keyframe(scene.map, {3, scene.pose});
  vo::place_landmarks(scene.map, options().map);
  for (std::size_t i = 0; i < 4; ++i)
    scene.frames.push_back({.frame = i, .before = vo::AnchoredPose{0, turned(0, {0, 0, 0.1 * double(i)})}});
  vo::renew_landmarks(scene, view(0.3), camera(), options());
  return scene;
}

TEST(SceneTracking, FindsTheCameraInALaterFrame) {
  for (const std::size_t frames : {1U, 3U}) {
    const double z_m = 0.3 + 0.1 * static_cast<double>(frames);
    vo::TrackedScene tracked = scene();
    const vo::LandmarkPose pose = vo::locate(tracked, 3 + frames, vo::klt_pyramid(view(0.3)),
                                             vo::klt_pyramid(view(z_m)), camera(), options());
    ASSERT_EQ(pose.loss, TrackLoss::kNone);
    // Depths from 0.3 m of way are good to some percent, and so is a way of as much.
    EXPECT_NEAR(pose.found.camera.position[2], z_m, 0.02);
    vo::add_frame(tracked, 3 + frames, pose.found, view(z_m), camera(), options());
    EXPECT_EQ(tracked.frames.size(), 4 + frames);
    for (std::size_t i = 0; i < tracked.frames.size(); ++i) {
      EXPECT_EQ(tracked.frames[i].frame, i);
      EXPECT_EQ(tracked.frames[i].before.has_value(), i < 4 || i == 3 + frames) << i;
    }
    EXPECT_NEAR(tracked.motion.position[2], 0.1, 0.02);  // of one frame, however many there were
  }
}

TEST(SceneTracking, IsAsItWasWhereNothingIsFound) {
  vo::TrackedScene tracked = scene();
  const std::size_t followed = vo::followed_landmarks(tracked.map);
  const cv::Mat black(200, 320, CV_8UC1, cv::Scalar(0));
  const vo::LandmarkPose pose =
      vo::locate(tracked, 4, vo::klt_pyramid(view(0.3)), vo::klt_pyramid(black), camera(), options());
  EXPECT_EQ(pose.loss, TrackLoss::kTooFewCorners);
  EXPECT_EQ(vo::followed_landmarks(tracked.map), followed);
  EXPECT_EQ(
      vo::locate(tracked, 4, vo::klt_pyramid(view(0.3)), vo::klt_pyramid(view(0.4)), camera(), options())
          .loss,
      TrackLoss::kNone);
}

TEST(SceneTracking, AJumpIsNoMotion) {
  vo::TrackedScene tracked = scene();
  tracked.speeds.assign(20, 0.01);  // it crept
  tracked.median_depth = 0.5;       // so that 0.1 m is no start from standing
  const auto last = vo::klt_pyramid(view(0.3)), next = vo::klt_pyramid(view(0.4));
  EXPECT_EQ(vo::locate(tracked, 4, last, next, camera(), options()).loss, TrackLoss::kJump);
  tracked.speeds.assign(20, 0.03);
  EXPECT_EQ(vo::locate(tracked, 4, last, next, camera(), options()).loss, TrackLoss::kNone);
}

TEST(SceneTracking, MeasuresTheHeightOfEveryKeyframe) {
  vo::TrackedScene tracked = scene();
  double z_m = 0.3;
  for (std::size_t frame = 4; frame < 80; ++frame, z_m += 0.1) {
    const vo::LandmarkPose pose = vo::locate(tracked, frame, vo::klt_pyramid(view(z_m)),
                                             vo::klt_pyramid(view(z_m + 0.1)), camera(), options());
    ASSERT_EQ(pose.loss, TrackLoss::kNone) << frame;
    vo::add_frame(tracked, frame, pose.found, view(z_m + 0.1), camera(), options());
  }
  EXPECT_LT(tracked.heights.size(), tracked.map.keyframes.size());  // the last wait for what comes
  vo::finish_heights(tracked, options());
  ASSERT_EQ(tracked.heights.size(), tracked.map.keyframes.size());
  std::vector<double> all;
  for (const auto& heights : tracked.heights) all.insert(all.end(), heights.begin(), heights.end());
  EXPECT_NEAR(vo::ground_height(all).value(), 1.5, 0.1);  // the floor, in a unit from 0.3 m of way
  EXPECT_FALSE(tracked.heights[0].empty());
}

TEST(SceneTracking, StandsIfItHardlyMoved) {
  vo::TrackedScene tracked{.median_depth = 10};
  EXPECT_FALSE(vo::is_still(tracked));  // nothing is known
  tracked.speeds = {0.001, 0.002, 0.3};
  EXPECT_TRUE(vo::is_still(tracked));
  tracked.speeds = {0.001, 0.02, 0.3};
  EXPECT_FALSE(vo::is_still(tracked));
}

}  // namespace
