#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <vo/geometry/resection.hpp>

namespace {

using test_support::point_scene;
using test_support::seen_by;
using test_support::turned;

constexpr double kNoise = 1e-3;

TEST(Resection, FindsTheCameraFromNearby) {
  const auto points = point_scene(80);
  const vo::Pose3 truth = turned(0.1, {0.3, -0.1, 0.5});
  const auto result = vo::resection(points, seen_by(truth, points), turned(0.05), {.noise = kNoise});
  EXPECT_LT(cv::norm(result.camera.position - truth.position), 1e-4);
  EXPECT_EQ(result.inliers, 80U);
}

TEST(Resection, TellsWhichPointsDoNotFit) {
  const auto points = point_scene(80);
  auto seen = seen_by({}, points, kNoise);
  for (std::size_t i = 0; i < 20; ++i) seen[i].x += 0.02;
  const auto result = vo::resection(points, seen, turned(0.02, {0.1, 0, 0.1}), {.noise = kNoise});
  for (std::size_t i = 0; i < 20; ++i) EXPECT_FALSE(result.fits[i]) << i;
  EXPECT_GE(result.inliers, 56U);  // 1.1 % of normal errors in the plane are beyond three deviations
  EXPECT_LT(cv::norm(result.camera.position), 0.02);
}

TEST(Resection, TriesRandomSamplesWhereTheStartIsFarOff) {
  const auto points = point_scene(80);
  auto seen = seen_by({}, points, kNoise / 4);
  for (std::size_t i = 0; i < 20; ++i) seen[i].x += 0.2;
  const auto result = vo::resection(points, seen, turned(0.6, {2, 1, -3}), {.noise = kNoise});
  EXPECT_GE(result.inliers, 56U);
  EXPECT_LT(cv::norm(result.camera.position), 0.02);
}

TEST(Resection, CovarianceIsThatOfRepeatedTrials) {
  const auto points = point_scene(60);
  cv::Matx33d measured = cv::Matx33d::zeros(), told = cv::Matx33d::zeros();
  constexpr int kTrials = 60;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    const auto result =
        vo::resection(points, seen_by({}, points, kNoise, 10 + trial), {}, {.noise = kNoise, .max_off = 5});
    measured += result.camera.position * result.camera.position.t() * (1.0 / kTrials);
    told += result.position_covariance * (1.0 / kTrials);
  }
  for (int i = 0; i < 3; ++i) {
    // A variance from 60 trials has a relative error of sqrt(2 / 60) = 0.18; Cauchy's weights cost a few
    // percent.
    EXPECT_NEAR(told(i, i) / measured(i, i), 1, 0.55) << i;
  }
}

TEST(Resection, UncertaintyOfADisplacementIsThatOfBothEnds) {
  vo::Resection found;
  found.position_covariance = cv::Matx33d::diag({0.04, 0.09, 0.16});
  EXPECT_NEAR(vo::displacement_sigma(found, {0, 0, 7}), std::sqrt(2) * 0.4, 1e-12);
  EXPECT_NEAR(vo::displacement_sigma(found, {3, 4, 0}), std::sqrt(2 * (0.36 * 0.04 + 0.64 * 0.09)), 1e-12);
  EXPECT_EQ(vo::displacement_sigma(found, {0, 0, 0}), 0);
}

TEST(Resection, OfTooFewPointsIsTheStart) {
  const auto points = point_scene(3);
  const auto result = vo::resection(points, seen_by({}, points), turned(0.3));
  EXPECT_EQ(result.inliers, 0U);
  EXPECT_EQ(result.fits.size(), 3U);
  EXPECT_EQ(result.camera.rotation, turned(0.3).rotation);
  EXPECT_EQ(vo::resection({}, {}, {}).inliers, 0U);
  EXPECT_THROW(vo::resection(points, {}, {}), std::invalid_argument);
}

}  // namespace
