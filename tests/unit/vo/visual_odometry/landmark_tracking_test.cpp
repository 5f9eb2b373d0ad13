#include "support/rendered_room.hpp"

#include <gtest/gtest.h>

#include <vo/geometry/triangulation.hpp>
#include <vo/visual_odometry/landmark_tracking.hpp>

namespace {

using test_support::turned;

vo::Camera camera() {
  return vo::camera_from_fov(320, 200, 70);
}

TEST(LandmarkTracking, FollowsCornersWhereTheyGo) {
  const test_support::RenderedRoom room;
  const vo::Pose3 then = turned(0.03);
  const cv::Mat first = room.view(camera(), {}), second = room.view(camera(), then);
  vo::LandmarkMap map;
  map.keyframes.push_back({0, {}});
  vo::add_corners(map, first, camera());
  const std::size_t corners = map.landmarks.size();
  ASSERT_GT(corners, 50U);
  vo::add_corners(map, first, camera());
  EXPECT_LT(map.landmarks.size(), corners * 11 / 10);  // every cell that can have one does
  map.landmarks.resize(corners);

  vo::follow_landmarks(map, vo::klt_pyramid(first), vo::klt_pyramid(second), camera(), std::nullopt);
  EXPECT_GT(vo::followed_landmarks(map), corners * 3 / 4);  // some went out of view
  std::size_t right = 0;
  for (const vo::Landmark& landmark : map.landmarks) {
    if (!landmark.followed) continue;
    const vo::ImagePoint& from = landmark.sightings[0].at;
    const auto expected = vo::project(then, cv::Vec3d(from.x, from.y, 1)).value();  // a turn has no parallax
    if (std::hypot(landmark.at.x - expected.x, landmark.at.y - expected.y) < 0.3 / camera().fx_px) ++right;
    EXPECT_NEAR(landmark.flow.x, camera().fx_px * (landmark.at.x - from.x), 1e-3);
  }
  EXPECT_GT(right, vo::followed_landmarks(map) * 9 / 10);
}

TEST(LandmarkTracking, LooksWhereThePoseTells) {
  const test_support::RenderedRoom room;
  const vo::Pose3 then = turned(0.15);  // 34 pixels, beyond a window without pyramid
  const cv::Mat first = room.view(camera(), {}), second = room.view(camera(), then);
  const vo::KltOptions flat{.levels = 0};
  vo::LandmarkMap map;
  map.keyframes.push_back({0, {}});
  vo::add_corners(map, first, camera());
  for (vo::Landmark& landmark : map.landmarks) landmark.position = 5 * vo::ray_of({}, landmark.at);
  vo::LandmarkMap blind = map;
  const auto before = vo::klt_pyramid(first, flat), after = vo::klt_pyramid(second, flat);
  vo::follow_landmarks(map, before, after, camera(), then, flat);
  vo::follow_landmarks(blind, before, after, camera(), std::nullopt, flat);
  EXPECT_GT(vo::followed_landmarks(map), 2 * vo::followed_landmarks(blind));
}

TEST(LandmarkTracking, OfNothingIsNothing) {
  const cv::Mat blank(200, 320, CV_8UC1, cv::Scalar(128));
  vo::LandmarkMap map;
  map.keyframes.push_back({0, {}});
  vo::add_corners(map, blank, camera());
  EXPECT_TRUE(map.landmarks.empty());
  vo::follow_landmarks(map, vo::klt_pyramid(blank), vo::klt_pyramid(blank), camera(), std::nullopt);
  EXPECT_EQ(vo::followed_landmarks(map), 0U);
}

}  // namespace
