#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <vo/geometry/bundle_adjustment.hpp>

namespace {

using test_support::turned;

/// Four cameras on a way that bends, and what they see, exactly.
vo::Bundle scene() {
  vo::Bundle bundle;
  for (int i = 0; i < 4; ++i) bundle.poses.push_back(turned(0.02 * i, {0.1 * i, 0, 0.4 * i}));
  bundle.points = test_support::point_scene(60);
  for (std::size_t pose = 0; pose < bundle.poses.size(); ++pose) {
    const auto seen = test_support::seen_by(bundle.poses[pose], bundle.points);
    for (std::size_t i = 0; i < seen.size(); ++i) bundle.observations.push_back({pose, i, seen[i]});
  }
  bundle.pose_fixed = {true, true, false, false};
  return bundle;
}

TEST(BundleAdjustment, FindsCamerasAndPointsAgain) {
  const vo::Bundle truth = scene();
  vo::Bundle bundle = truth;
  vo::Rng rng(4);
  for (std::size_t i = 2; i < 4; ++i)
    bundle.poses[i] =
        vo::compose(bundle.poses[i], turned(0.02, {0.1 * rng.normal(), 0.1 * rng.normal(), 0.1}));
  for (cv::Vec3d& point : bundle.points) point *= rng.uniform(0.8, 1.2);
  ASSERT_TRUE(vo::adjust(bundle, {.max_iterations = 50}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(cv::norm(bundle.poses[i].position - truth.poses[i].position), 1e-3) << i;
    EXPECT_LT(vo::angle_rad(bundle.poses[i].rotation.t() * truth.poses[i].rotation), 1e-4) << i;
  }
  EXPECT_EQ(bundle.poses[1].position, truth.poses[1].position);  // what is fixed is not touched
  for (const double error : vo::reprojection_errors(bundle)) EXPECT_LT(error, 1e-4);
}

TEST(BundleAdjustment, IsNotLedAstrayByOutliers) {
  vo::Bundle bundle = scene();
  const vo::Pose3 truth = bundle.poses[3];
  for (std::size_t i = 0; i < bundle.observations.size(); i += 10) bundle.observations[i].at.x += 0.05;
  bundle.poses[3].position += cv::Vec3d(0.05, 0, -0.05);
  ASSERT_TRUE(vo::adjust(bundle, {.max_iterations = 50}));
  // One in ten is 50 standard deviations off; without Cauchy's weights the camera is centimetres off.
  EXPECT_LT(cv::norm(bundle.poses[3].position - truth.position), 0.005);
}

TEST(BundleAdjustment, OfKnownPointsIsResection) {
  vo::Bundle bundle = scene();
  const vo::Pose3 truth = bundle.poses[3];
  bundle.point_fixed.assign(bundle.points.size(), true);
  const auto points = bundle.points;
  bundle.poses[3] = bundle.poses[2];
  ASSERT_TRUE(vo::adjust(bundle, {.max_iterations = 30}));
  EXPECT_LT(cv::norm(bundle.poses[3].position - truth.position), 1e-4);
  EXPECT_EQ(bundle.points, points);
}

TEST(BundleAdjustment, ErrorsAreDistancesOnTheImagePlane) {
  vo::Bundle bundle;
  bundle.poses = {{}};
  bundle.points = {{1, 0, 2}, {0, 0, -1}};
  bundle.observations = {{0, 0, {0.5 + 0.3, 0.4}}, {0, 1, {0, 0}}};
  const auto errors = vo::reprojection_errors(bundle);
  EXPECT_NEAR(errors[0], 0.5, 1e-12);
  EXPECT_TRUE(std::isinf(errors[1]));
}

TEST(BundleAdjustment, LearnsTheRadialDistortionLeftOver) {
  vo::Bundle bundle = scene();
  for (vo::BundleObservation& observation : bundle.observations)
    observation.at = vo::with_radial(observation.at, 0.03);
  vo::Bundle fixed = bundle;
  ASSERT_TRUE(vo::adjust(fixed, {.max_iterations = 50}));
  EXPECT_EQ(fixed.radial, 0);
  ASSERT_TRUE(vo::adjust(bundle, {.max_iterations = 50, .radial_sigma = 1}));
  // What is known beforehand pulls by a thousandth; the rest is where the solver stops.
  EXPECT_NEAR(bundle.radial, 0.03, 0.003);
  const auto worst = [](const vo::Bundle& b) { return std::ranges::max(vo::reprojection_errors(b)); };
  EXPECT_LT(worst(bundle), worst(fixed) / 5);
  vo::Bundle known = scene();
  ASSERT_TRUE(vo::adjust(known, {.max_iterations = 50, .radial_mean = 0.01, .radial_sigma = 1e-6}));
  EXPECT_NEAR(known.radial, 0.01, 1e-5);  // what is known beforehand holds
}

TEST(BundleAdjustment, OfNothingIsNothing) {
  vo::Bundle bundle;
  EXPECT_TRUE(vo::adjust(bundle));
  bundle.observations = {{0, 0, {}}};
  EXPECT_THROW(vo::adjust(bundle), std::invalid_argument);
  bundle = scene();
  bundle.pose_fixed.pop_back();
  EXPECT_THROW(vo::adjust(bundle), std::invalid_argument);
}

}  // namespace
