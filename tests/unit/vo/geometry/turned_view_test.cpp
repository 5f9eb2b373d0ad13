#include "vo/geometry/turned_view.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace vo {
namespace {

constexpr double kExact_px = 1e-9;  // a few products of numbers below a thousand

/// Where a pixel goes.
cv::Point2d moved(const cv::Matx33d& homography, double x, double y) {
  const cv::Vec3d to = homography * cv::Vec3d(x, y, 1);
  return {to[0] / to[2], to[1] / to[2]};
}

/// Where a camera at the origin, turned to the right, sees a point: x right, y down, z ahead.
cv::Point2d seen(const Camera& camera, double turn_rad, double x, double y, double z) {
  const double ahead = z * std::cos(turn_rad) + x * std::sin(turn_rad);
  const double right = x * std::cos(turn_rad) - z * std::sin(turn_rad);
  return {camera.cx_px + camera.fx_px * right / ahead, camera.cy_px + camera.fy_px * y / ahead};
}

TEST(TurnedView, WhatLayAheadLiesToTheLeftOfACameraTurnedToTheRight) {
  const Camera camera = camera_from_fov(640, 360, 90);  // focal length 320
  const cv::Point2d ahead =
      moved(turned_view(camera, camera, std::numbers::pi / 4), camera.cx_px, camera.cy_px);
  EXPECT_NEAR(ahead.x, camera.cx_px - camera.fx_px, kExact_px);  // tan 45 degrees is one
  EXPECT_NEAR(ahead.y, camera.cy_px, kExact_px);
}

TEST(TurnedView, TakesEveryPointWhereTheOtherCameraSeesIt) {
  const Camera from = camera_from_fov(640, 360, 64.4), to = camera_from_fov(320, 240, 80);
  for (const double turn_rad : {-0.4, 0.0, 0.2}) {
    const cv::Matx33d homography = turned_view(from, to, turn_rad);
    for (const double x : {-2.0, 0.0, 3.0}) {
      const cv::Point2d in_from = seen(from, 0, x, 0.7, 9), in_to = seen(to, turn_rad, x, 0.7, 9);
      const cv::Point2d taken = moved(homography, in_from.x, in_from.y);
      EXPECT_NEAR(taken.x, in_to.x, kExact_px) << turn_rad << ' ' << x;
      EXPECT_NEAR(taken.y, in_to.y, kExact_px) << turn_rad << ' ' << x;
    }
  }
}

TEST(TurnedView, NoTurnOfOneCameraChangesNothing) {
  const Camera camera = camera_from_fov(640, 360, 64.4);
  const cv::Point2d same = moved(turned_view(camera, camera, 0), 17, 301);
  EXPECT_NEAR(same.x, 17, kExact_px);
  EXPECT_NEAR(same.y, 301, kExact_px);
}

TEST(TurnedView, RefusesWhatIsNoCameraOrNoTurn) {
  const Camera camera = camera_from_fov(640, 360, 64.4);
  EXPECT_THROW(turned_view(Camera(), camera, 0), std::invalid_argument);
  EXPECT_THROW(turned_view(camera, Camera(), 0), std::invalid_argument);
  EXPECT_THROW(turned_view(camera, camera, std::numbers::pi / 2), std::invalid_argument);
  EXPECT_THROW(turned_view(camera, camera, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace vo
