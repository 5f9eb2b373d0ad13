#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vo/base/rng.hpp>
#include <vo/io/trajectory_axes.hpp>

namespace {

using vo::BodyAxes;
using vo::GroundPlane;

/// A walk around a quarter of a circle of 20 m and 30 m straight on, the body's x forward, y left, z up, in a
/// world with z up; a metre a pose, with a walker's sway of 3 cm.
std::vector<vo::Pose3> walk() {
  vo::Rng rng(1);
  std::vector<vo::Pose3> poses;
  cv::Vec3d at(3, -2, 1.5);
  for (int i = 0; i < 61; ++i) {
    const double yaw = i < 31 ? i / 20.0 : 1.55;
    const double c = std::cos(yaw), s = std::sin(yaw);
    const cv::Vec3d sway(rng.uniform() * 0.06 - 0.03, rng.uniform() * 0.06 - 0.03,
                         rng.uniform() * 0.06 - 0.03);
    poses.push_back({.rotation = {c, -s, 0, s, c, 0, 0, 0, 1}, .position = at + sway});
    at += cv::Vec3d(c, s, 0);
  }
  return poses;
}

/// The same bodies with other axes: vehicle_from_camera has the camera's x right, y down, z forward in
/// columns.
const cv::Matx33d kVehicleFromCamera(0, 0, 1, -1, 0, 0, 0, -1, 0);

std::vector<vo::Pose3> changed(std::vector<vo::Pose3> poses, const cv::Matx33d& world,
                               const cv::Matx33d& body) {
  for (vo::Pose3& pose : poses)
    pose = {.rotation = world * pose.rotation * body, .position = world * pose.position};
  return poses;
}

TEST(TrajectoryAxes, FindsBodyAndGround) {
  const cv::Matx33d same = cv::Matx33d::eye();
  const auto vehicle = vo::find_axes(walk());
  EXPECT_EQ(vehicle.body, BodyAxes::kVehicle);
  EXPECT_EQ(vehicle.ground, GroundPlane::kXY);
  const auto camera = vo::find_axes(changed(walk(), kVehicleFromCamera.t(), kVehicleFromCamera));
  EXPECT_EQ(camera.body, BodyAxes::kCamera);
  EXPECT_EQ(camera.ground, GroundPlane::kXZ);
  const auto camera_on_a_map = vo::find_axes(changed(walk(), same, kVehicleFromCamera));  // TUM's RGB-D
  EXPECT_EQ(camera_on_a_map.body, BodyAxes::kCamera);
  EXPECT_EQ(camera_on_a_map.ground, GroundPlane::kXY);
}

TEST(TrajectoryAxes, ACameraMayLookDown) {
  const double c = std::cos(0.5), s = std::sin(0.5);  // 29 degrees, about its own x
  const cv::Matx33d down(1, 0, 0, 0, c, -s, 0, s, c);
  const auto found = vo::find_axes(changed(walk(), kVehicleFromCamera.t(), kVehicleFromCamera * down));
  EXPECT_EQ(found.body, BodyAxes::kCamera);
  EXPECT_EQ(found.ground, GroundPlane::kXZ);
}

TEST(TrajectoryAxes, WithoutOrientationThePathIsFlat) {
  std::vector<vo::Pose3> poses = walk();
  for (vo::Pose3& pose : poses) pose.rotation = cv::Matx33d::eye();
  EXPECT_EQ(vo::find_axes(poses).ground, GroundPlane::kXY);
  EXPECT_EQ(vo::find_axes(poses).body, BodyAxes::kNone);
  EXPECT_EQ(vo::find_axes(changed(poses, kVehicleFromCamera.t(), cv::Matx33d::eye())).ground,
            GroundPlane::kXZ);
}

TEST(TrajectoryAxes, SaysSoWhereNothingIsToBeSeen) {
  // A path that climbs as fast as it goes, orientations that do not follow it.
  std::vector<vo::Pose3> steep;
  for (int i = 0; i < 20; ++i) steep.push_back({.position = {0.0, -1.0 * i, -1.0 * i}});
  EXPECT_EQ(vo::find_axes(steep).ground, GroundPlane::kUnknown);
  EXPECT_EQ(vo::find_axes(steep).body, BodyAxes::kNone);
}

TEST(TrajectoryAxes, WhatDoesNotMoveIsTakenAsItIs) {
  const std::vector<vo::Pose3> none, one(1), still(5);
  for (const auto& poses : {none, one, still}) {
    EXPECT_EQ(vo::find_axes(poses).ground, GroundPlane::kXY);
    EXPECT_EQ(vo::find_axes(poses).body, BodyAxes::kVehicle);
  }
}

}  // namespace
