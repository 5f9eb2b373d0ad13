#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <vo/visual_odometry/landmark_pose.hpp>

namespace {

using test_support::turned;
using vo::TrackLoss;

const vo::Camera kCamera = vo::camera_from_fov(320, 200, 70);
const cv::Size kPicture{320, 200};

/// Landmarks as a camera sees them.
vo::LandmarkMap map_seen_by(const vo::Pose3& camera, const std::vector<cv::Vec3d>& points) {
  vo::LandmarkMap map;
  const std::vector<vo::ImagePoint> seen = test_support::seen_by(camera, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    vo::Landmark landmark{.at = seen[i], .sightings = {}, .position = points[i]};
    landmark.pixel = {static_cast<float>(kCamera.cx_px + kCamera.fx_px * seen[i].x),
                      static_cast<float>(kCamera.cy_px + kCamera.fy_px * seen[i].y)};
    map.landmarks.push_back(landmark);
  }
  return map;
}

TEST(LandmarkPose, IsThatOfTheCameraAndDropsWhatDoesNotFit) {
  const vo::Pose3 camera = turned(0.1, {0.2, -0.1, 0.5});
  vo::LandmarkMap map = map_seen_by(camera, test_support::point_scene(40));
  for (std::size_t i = 0; i < 10; ++i) map.landmarks[i].at.x += 0.2;  // followed something else
  map.landmarks[39].position.reset();                                 // its depth is not known yet
  const vo::LandmarkPose pose = vo::pose_by_landmarks(map, {}, kPicture);
  EXPECT_EQ(pose.loss, TrackLoss::kNone);
  EXPECT_EQ(pose.landmarks, 39U);
  EXPECT_EQ(pose.found.inliers, 29U);
  EXPECT_NEAR(cv::norm(pose.found.camera.position - camera.position), 0, 1e-3);  // those pull a little
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(map.landmarks[i].followed, i >= 10) << i;
}

TEST(LandmarkPose, SaysWhatIsMissing) {
  const std::vector<cv::Vec3d> points = test_support::point_scene(40);
  vo::LandmarkMap few = map_seen_by({}, points);
  for (std::size_t i = 19; i < 40; ++i) few.landmarks[i].followed = false;
  EXPECT_EQ(vo::pose_by_landmarks(few, {}, kPicture).loss, TrackLoss::kTooFewCorners);

  vo::LandmarkMap unplaced = map_seen_by({}, points);
  for (std::size_t i = 7; i < 40; ++i) unplaced.landmarks[i].position.reset();
  const vo::LandmarkPose of_seven = vo::pose_by_landmarks(unplaced, {}, kPicture);
  EXPECT_EQ(of_seven.loss, TrackLoss::kTooFewInliers);
  EXPECT_EQ(of_seven.landmarks, 7U);

  vo::LandmarkMap astray = map_seen_by({}, points);  // enough that fit, but most do not
  for (std::size_t i = 0; i < 25; ++i) astray.landmarks[i].at.y += 0.05 * static_cast<double>(1 + i);
  EXPECT_EQ(vo::pose_by_landmarks(astray, {}, kPicture).loss, TrackLoss::kTooFewInliers);

  std::vector<cv::Vec3d> corner;  // all in two cells of 53 x 50 pixels
  for (const cv::Vec3d& p : points) corner.emplace_back(p[2] * (0.1 + 0.1 * p[0] / p[2]), 0.1 * p[1], p[2]);
  vo::LandmarkMap crowded = map_seen_by({}, corner);
  EXPECT_EQ(vo::pose_by_landmarks(crowded, {}, kPicture).loss, TrackLoss::kPoorSpread);
  vo::LandmarkMap nothing;
  EXPECT_EQ(vo::pose_by_landmarks(nothing, {}, kPicture).loss, TrackLoss::kTooFewCorners);
}

}  // namespace
