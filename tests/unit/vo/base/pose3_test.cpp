#include "support/rendered_room.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <vo/base/pose3.hpp>

namespace {

using test_support::turned;

constexpr double kDegree = std::numbers::pi / 180;

void expect_near(const vo::Pose3& a, const vo::Pose3& b) {
  EXPECT_LT(cv::norm(a.rotation - b.rotation), 1e-12);
  EXPECT_LT(cv::norm(a.position - b.position), 1e-12);
}

TEST(Pose3, ComposesAndInverts) {
  // A quarter turn to the right at (1, 0, 0): what is 2 ahead lies at (3, 0, 0).
  const vo::Pose3 world_from_a = turned(90 * kDegree, {1, 0, 0});
  const vo::Pose3 a_from_b = turned(30 * kDegree, {0, 0, 2});
  expect_near(vo::compose(world_from_a, a_from_b), turned(120 * kDegree, {3, 0, 0}));
  expect_near(vo::compose(world_from_a, vo::inverse(world_from_a)), {});
  expect_near(vo::compose(vo::inverse(world_from_a), world_from_a), {});
}

TEST(Pose3, InterpolatesBetween) {
  const vo::Pose3 a = turned(170 * kDegree, {0, 0, 0}), b = turned(-170 * kDegree, {4, 0, 0});
  expect_near(vo::interpolate(a, b, 0), a);
  expect_near(vo::interpolate(a, b, 1), b);
  expect_near(vo::interpolate(a, b, 0.25), turned(175 * kDegree, {1, 0, 0}));  // the shorter arc
}

TEST(Pose3, AngleOfARotation) {
  EXPECT_EQ(vo::angle_rad(cv::Matx33d::eye()), 0);
  EXPECT_NEAR(vo::angle_rad(turned(-40 * kDegree).rotation), 40 * kDegree, 1e-12);
  EXPECT_NEAR(vo::angle_rad(turned(180 * kDegree).rotation), 180 * kDegree, 1e-12);
  EXPECT_NEAR(vo::angle_rad(turned(1e-7).rotation), 1e-7, 1e-12);  // where an arc cosine has no digits left
}

}  // namespace
