#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/visual_odometry/scene_start.hpp>

namespace {

using test_support::seen_by;
using test_support::turned;

constexpr double kNoise = 5e-4;
const vo::LandmarkMapOptions kMap{.noise = kNoise};

struct Start {
  vo::LandmarkMap map;
  std::vector<vo::WaitingFrame> waiting;
};

/// A first keyframe at the origin, and frames that wait.
Start start(const std::vector<vo::Pose3>& poses, const std::vector<cv::Vec3d>& points) {
  Start result;
  result.map.keyframes.push_back({7, {}});
  result.map.landmarks.resize(points.size());
  const auto first = seen_by({}, points, kNoise, 1);
  for (std::size_t i = 0; i < points.size(); ++i) result.map.landmarks[i].sightings.push_back({0, first[i]});
  for (std::size_t frame = 0; frame < poses.size(); ++frame) {
    const auto seen = seen_by(poses[frame], points, kNoise, 2 + frame);
    for (std::size_t i = 0; i < points.size(); ++i) result.map.landmarks[i].at = seen[i];
    result.waiting.push_back(vo::waiting_frame(result.map, 8 + frame, kNoise));
  }
  return result;
}

TEST(SceneStart, BeginsWithTheMedianDepthAsUnit) {
  const auto points = test_support::point_scene(120);
  std::vector<vo::Pose3> poses;
  for (int i = 1; i <= 4; ++i) poses.push_back(turned(0.01 * i, {0.1 * i, 0, 0.15 * i}));
  Start scene = start(poses, points);
  const auto segment = vo::begin_scene(scene.map, scene.waiting, kMap, {});
  ASSERT_EQ(segment.size(), 5U);
  ASSERT_EQ(scene.map.keyframes.size(), 2U);
  EXPECT_EQ(segment[0].frame, 7U);
  EXPECT_EQ(segment[4].frame, 11U);
  std::vector<double> depths;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (scene.map.landmarks[i].position) depths.push_back((*scene.map.landmarks[i].position)[2]);
  }
  ASSERT_GT(depths.size(), 60U);
  std::ranges::sort(depths);
  EXPECT_NEAR(depths[depths.size() / 2], 1, 0.05);  // adjusting moves it a little
  // Frames in between are at their share of the way, to the noise of a point over the root of their number.
  const double way = cv::norm(scene.map.keyframes[1].pose.position);
  for (std::size_t i = 1; i < 4; ++i) {
    ASSERT_TRUE(segment[i].before);
    EXPECT_GT(segment[i].sigma, 0);
    EXPECT_NEAR(cv::norm(segment[i].before->in_keyframe.position) / way, 0.25 * static_cast<double>(i), 0.03);
  }
}

TEST(SceneStart, DoesNotBeginWithoutParallax) {
  const auto points = test_support::point_scene(120);
  Start scene = start({turned(0.2), turned(0.3)}, points);
  EXPECT_TRUE(vo::begin_scene(scene.map, scene.waiting, kMap, {}).empty());
  EXPECT_EQ(scene.map.keyframes.size(), 1U);
  EXPECT_FALSE(scene.map.landmarks[0].position);
}

TEST(SceneStart, TellsATurnFromATravel) {
  const auto points = test_support::point_scene(120);
  const Start turning = start({turned(0.1), turned(0.2)}, points);
  EXPECT_LT(turning.waiting[1].off, 3 * kNoise);
  EXPECT_LT(vo::angle_rad(turning.waiting[1].rotation.t() * turned(0.2).rotation), kNoise);
  EXPECT_TRUE(vo::stood_or_turned(turning.waiting, 0.1, kNoise));  // 11 degrees: enough to see a travel in
  const Start standing = start({{}, {}}, points);
  EXPECT_TRUE(vo::stood_or_turned(standing.waiting, 1, kNoise));
  EXPECT_FALSE(vo::stood_or_turned(standing.waiting, 0.1, kNoise));  // too short to tell
  const Start travelling = start({turned(0.1, {0.2, 0, 0}), turned(0.2, {0.4, 0, 0})}, points);
  EXPECT_FALSE(vo::stood_or_turned(travelling.waiting, 1, kNoise));
  EXPECT_FALSE(vo::stood_or_turned({}, 1, kNoise));
  EXPECT_THROW(vo::waiting_frame({}, 0, kNoise), std::invalid_argument);
}

}  // namespace
