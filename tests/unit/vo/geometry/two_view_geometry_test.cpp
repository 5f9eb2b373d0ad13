#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/geometry/two_view_geometry.hpp>

namespace {

using test_support::point_scene;
using test_support::seen_by;
using test_support::turned;

constexpr double kNoise = 5e-4;  // a quarter of a pixel at 500 px focal length

double angle_to(const cv::Vec3d& a, const cv::Vec3d& b) {
  return vo::angle_between_rad(cv::normalize(a), cv::normalize(b));
}

TEST(ViewRotation, IsTheTurnOfACameraThatTurns) {
  const auto points = point_scene(60);
  const vo::Pose3 then = turned(0.1);
  const auto result = vo::view_rotation(seen_by({}, points), seen_by(then, points), kNoise);
  EXPECT_LT(cv::norm(result.rotation - then.rotation), 1e-9);
  EXPECT_LT(*std::ranges::max_element(result.off), 1e-9);
}

TEST(ViewRotation, IsThatOfMostPoints) {
  const auto points = point_scene(60);
  auto to = seen_by(turned(0.1), points);
  for (std::size_t i = 0; i < 15; ++i) to[i].x += 0.05;  // a passer-by
  const auto result = vo::view_rotation(seen_by({}, points), to, kNoise);
  EXPECT_LT(vo::angle_rad(result.rotation.t() * turned(0.1).rotation), 2 * kNoise);
  EXPECT_NEAR(result.off[0], 0.05, 2 * kNoise);
  EXPECT_THROW(vo::view_rotation({}, {}, kNoise), std::invalid_argument);
}

TEST(TwoViewGeometry, FindsMotionAndPoints) {
  const auto points = point_scene(150);
  const vo::Pose3 then = turned(0.05, {0.2, 0.05, 0.6});
  auto from = seen_by({}, points, kNoise, 3), to = seen_by(then, points, kNoise, 4);
  for (std::size_t i = 0; i < 30; ++i) to[i].y += 0.03;  // one in five does not fit
  const auto result = vo::two_view_geometry(from, to, {.noise = kNoise});
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->planar);
  EXPECT_LT(angle_to(result->second.position, then.position), 0.03);
  EXPECT_LT(vo::angle_rad(result->second.rotation.t() * then.rotation), 0.002);
  EXPECT_NEAR(cv::norm(result->second.position), 1, 1e-9);
  EXPECT_GT(result->inliers, 90U);  // points near the way's vanishing point say little
  std::vector<double> ratios;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i < 30) {
      EXPECT_FALSE(result->points[i]) << i;
    } else if (result->points[i])
      ratios.push_back((*result->points[i])[2] / points[i][2]);
  }
  std::ranges::sort(ratios);
  EXPECT_NEAR(ratios[ratios.size() / 2], 1 / cv::norm(then.position), 0.05);
}

TEST(TwoViewGeometry, TakesTheHomographyForAWall) {
  std::vector<cv::Vec3d> wall;
  for (const cv::Vec3d& p : point_scene(150)) wall.emplace_back(p[0], p[1], 6 + 0.3 * p[0]);
  const vo::Pose3 then = turned(0.03, {0.8, 0.1, 0.2});
  const auto result =
      vo::two_view_geometry(seen_by({}, wall, kNoise, 3), seen_by(then, wall, kNoise, 4), {.noise = kNoise});
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->planar);
}

TEST(TwoViewGeometry, GivesTheSameForTheSameSeed) {
  const auto points = point_scene(100);
  const auto from = seen_by({}, points, kNoise, 3),
             to = seen_by(turned(0.05, {0.3, 0, 0.5}), points, kNoise, 4);
  const auto a = vo::two_view_geometry(from, to, {.noise = kNoise, .seed = 7});
  const auto b = vo::two_view_geometry(from, to, {.noise = kNoise, .seed = 7});
  EXPECT_EQ(a.value().second.position, b.value().second.position);
}

TEST(TwoViewGeometry, HasNoAnswerForTooFewPointsOrNoise) {
  const auto points = point_scene(10);
  EXPECT_FALSE(vo::two_view_geometry({}, {}));
  EXPECT_FALSE(vo::two_view_geometry(seen_by({}, points), seen_by(turned(0.1, {1, 0, 0}), points)));
  vo::Rng rng(1);
  std::vector<vo::ImagePoint> from, to;
  for (int i = 0; i < 100; ++i) {
    from.push_back({rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)});
    to.push_back({rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)});
  }
  EXPECT_FALSE(vo::two_view_geometry(from, to, {.noise = kNoise}));
  EXPECT_THROW(vo::two_view_geometry(from, {}), std::invalid_argument);
}

}  // namespace
