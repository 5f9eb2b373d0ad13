#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <vo/visual_odometry/landmark_map.hpp>

namespace {

using test_support::seen_by;
using test_support::turned;

const vo::LandmarkMapOptions kOptions{.noise = 5e-4, .min_parallax_rad = 0.01, .window = 4};

vo::Pose3 camera(int i) {
  return turned(0.02 * i, {0.05 * i, 0, 0.2 * i});
}

/// Makes the followed landmarks seen where the camera sees the points.
void look(vo::LandmarkMap& map, const vo::Pose3& pose, const std::vector<cv::Vec3d>& points) {
  const auto seen = seen_by(pose, points);
  for (std::size_t i = 0; i < points.size(); ++i) map.landmarks[i].at = seen[i];
}

/// A map of points seen by so many keyframes, without positions.
vo::LandmarkMap map_of(const std::vector<cv::Vec3d>& points, int keyframes) {
  vo::LandmarkMap map;
  map.landmarks.resize(points.size());
  for (int i = 0; i < keyframes; ++i) {
    look(map, camera(i), points);
    vo::add_keyframe(map, {static_cast<std::size_t>(10 * i), camera(i)});
  }
  return map;
}

TEST(LandmarkMap, KeyframesSeeWhatIsFollowed) {
  const auto points = test_support::point_scene(5);
  vo::LandmarkMap map = map_of(points, 2);
  map.landmarks[3].followed = false;
  vo::add_keyframe(map, {20, camera(2)});
  EXPECT_EQ(map.keyframes.size(), 3U);
  EXPECT_EQ(map.landmarks[0].sightings.size(), 3U);
  EXPECT_EQ(map.landmarks[0].sightings.back().keyframe, 2U);
  EXPECT_EQ(map.landmarks[3].sightings.size(), 2U);
}

TEST(LandmarkMap, PlacesLandmarksOnceThereIsParallax) {
  auto points = test_support::point_scene(40);
  points.push_back({0, 0, 1000});  // from 0.6 m on: under 0.0006 rad
  vo::LandmarkMap map = map_of(points, 4);
  map.landmarks[5].sightings[1].at.x += 0.01;  // 20 deviations off
  map.landmarks[6].followed = false;
  vo::place_landmarks(map, kOptions);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& position = map.landmarks[i].position;
    if (i == 5 || i == 6 || i == 40) {
      EXPECT_FALSE(position) << i;
    } else if (position) {
      EXPECT_LT(cv::norm(*position - points[i]), 1e-6) << i;
    }
  }
  EXPECT_GT(std::ranges::count_if(map.landmarks, [](const auto& l) { return l.position.has_value(); }), 25);
}

TEST(LandmarkMap, AdjustsTheWindowAndLeavesWhatIsBefore) {
  const auto points = test_support::point_scene(60);
  vo::LandmarkMap map = map_of(points, 7);
  for (std::size_t i = 0; i < points.size(); ++i) map.landmarks[i].position = points[i] * 1.01;
  for (int i = 3; i < 7; ++i) map.keyframes[static_cast<std::size_t>(i)].pose.position *= 1.03;
  map.landmarks[2].sightings[4].at.x += 0.02;
  map.landmarks[3].sightings[6].at.x += 0.02;  // the last one: it has drifted off
  for (int i = 0; i < 5; ++i) vo::adjust_window(map, kOptions);
  for (int i = 0; i < 7; ++i) {
    const cv::Vec3d off = map.keyframes[static_cast<std::size_t>(i)].pose.position - camera(i).position;
    EXPECT_LE(cv::norm(off), i < 3 ? 0 : 2e-3) << i;  // the outliers pull until they are dropped
  }
  EXPECT_EQ(map.landmarks[2].sightings.size(), 6U);
  EXPECT_TRUE(map.landmarks[2].followed);
  EXPECT_EQ(map.landmarks[3].sightings.size(), 6U);
  EXPECT_FALSE(map.landmarks[3].followed);
  EXPECT_EQ(map.landmarks[4].sightings.size(), 7U);
}

TEST(LandmarkMap, TakesRadialDistortionOutOfAllPoints) {
  constexpr double kRadial = 0.02;
  const auto points = test_support::point_scene(80);
  vo::LandmarkMap map = map_of(points, 3);
  for (vo::Landmark& landmark : map.landmarks) {
    for (auto& sighting : landmark.sightings) sighting.at = vo::with_radial(sighting.at, kRadial);
  }
  for (std::size_t i = 0; i < points.size(); ++i) map.landmarks[i].position = points[i];
  vo::adjust_window(map, kOptions);
  EXPECT_EQ(map.radial, 0);  // the first keyframes alone cannot tell it
  for (int i = 3; i < 12; ++i) {
    look(map, camera(i), points);
    for (vo::Landmark& landmark : map.landmarks)
      landmark.at = vo::without_radial(vo::with_radial(landmark.at, kRadial), map.radial);
    vo::add_keyframe(map, {static_cast<std::size_t>(10 * i), camera(i)});
    vo::adjust_window(map, kOptions);
  }
  EXPECT_NEAR(map.radial, kRadial, kRadial / 4);  // on its way there, by steps
  const vo::ImagePoint at = *vo::project(camera(11), points[0]);
  const vo::ImagePoint expected = vo::without_radial(vo::with_radial(at, kRadial), map.radial);
  EXPECT_NEAR(map.landmarks[0].at.x, expected.x, 1e-9);
  EXPECT_NEAR(map.landmarks[0].sightings.back().at.x, expected.x, 1e-9);
}

TEST(LandmarkMap, ForgetsWhatTheWindowDoesNotSee) {
  const auto points = test_support::point_scene(4);
  vo::LandmarkMap map = map_of(points, 2);
  for (auto& landmark : map.landmarks) landmark.position = cv::Vec3d(0, 0, 5);
  map.landmarks[0].followed = false;  // last seen by keyframe 1
  map.landmarks[1].followed = false;
  map.landmarks[1].position.reset();
  for (int i = 2; i < 5; ++i) vo::add_keyframe(map, {static_cast<std::size_t>(10 * i), camera(i)});
  vo::prune(map, kOptions);  // keyframes 1 to 4
  EXPECT_EQ(map.landmarks.size(), 3U);
  vo::add_keyframe(map, {50, camera(5)});
  vo::prune(map, kOptions);
  EXPECT_EQ(map.landmarks.size(), 2U);
}

TEST(LandmarkMap, OfNothingIsNothing) {
  vo::LandmarkMap map;
  vo::place_landmarks(map, kOptions);
  vo::adjust_window(map, kOptions);
  vo::prune(map, kOptions);
  vo::add_keyframe(map, {0, {}});
  vo::adjust_window(map, kOptions);
  EXPECT_EQ(map.keyframes.size(), 1U);
}

}  // namespace
