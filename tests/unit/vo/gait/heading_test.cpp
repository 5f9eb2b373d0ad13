#include "support/tracked_scene.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/gait/heading.hpp>

namespace {

using test_support::CameraMove;
using test_support::tracked_points;
using vo::HeadingMethod;

constexpr double kDegrees = 180 / std::numbers::pi;
const vo::Camera kCamera = vo::camera_from_fov(640, 360, 64.4);

double turn_deg(const std::vector<vo::TrackedPoint>& points, HeadingMethod method) {
  const auto turned = vo::turn(points, kCamera, {.method = method});
  EXPECT_TRUE(turned.has_value());
  return turned ? turned->turn_rad * kDegrees : NAN;
}

TEST(Turn, IsTheShiftDividedByPixelsPerDegree) {
  // PVO 5.3 (6): 640 / 64.4 = 9.94 pixels a degree. 19.88 pixels to the left are 2 degrees to the right.
  std::vector<vo::TrackedPoint> points(20);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].from.x_px = 100 + 20 * static_cast<float>(i);
    points[i].to.x_px = points[i].from.x_px - 2 * 640 / 64.4F;
  }
  EXPECT_NEAR(turn_deg(points, HeadingMethod::kNaive), 2, 1e-4);  // single precision of the points
}

TEST(Turn, OfPureRotationIsSeenByAll) {
  for (const double degrees : {-5.0, -0.5, 0.0, 0.3, 4.0}) {
    const auto points = tracked_points(kCamera, {.turn_rad = degrees / kDegrees}, 300);
    EXPECT_NEAR(turn_deg(points, HeadingMethod::kEpipolar), degrees, 0.01);
    // Off the horizontal, a turn moves points along curves, by up to 5 % less at the rim: a few hundredths.
    EXPECT_NEAR(turn_deg(points, HeadingMethod::kRegions), degrees, 0.02 + 0.03 * std::abs(degrees));
    // Pixels per degree at the middle are fewer than the mean, by up to 12 % for 64.4 degrees.
    EXPECT_NEAR(turn_deg(points, HeadingMethod::kNaive), degrees, 0.02 + 0.12 * std::abs(degrees));
  }
}

TEST(Turn, WalkingPastAWallOnOneSideTurnsOnlyTheMedians) {
  // Everything seen is on the left, near: the picture flows to the left, as if the walker turned right.
  const auto left = [](vo::Rng& rng) {
    return Eigen::Vector3d(-2, rng.uniform(-1.5, 1.5), rng.uniform(4, 15));
  };
  const CameraMove step{.turn_rad = 0.4 / kDegrees, .travel_m = {0, 0, 0.15}};
  const auto points = tracked_points(kCamera, step, 300, left, 0.2);
  EXPECT_NEAR(turn_deg(points, HeadingMethod::kEpipolar), 0.4, 0.06);  // 0.2 px are 0.02 degrees each
  EXPECT_GT(turn_deg(points, HeadingMethod::kNaive), 0.5);
  EXPECT_GT(turn_deg(points, HeadingMethod::kRegions), 0.5);
}

TEST(Turn, APasserByInOneStripTurnsNobodyByRegions) {
  const CameraMove step{.turn_rad = 1 / kDegrees, .travel_m = {0, 0, 0.05}};
  auto points = tracked_points(kCamera, step, 200, test_support::anywhere, 0.2);
  // He fills the middle and has more texture than all the rest; he goes right by 30 pixels.
  vo::Rng rng(3);
  for (int i = 0; i < 250; ++i) {
    vo::TrackedPoint his;
    his.from.x_px = static_cast<float>(rng.uniform(330, 390));
    his.from.y_px = his.to.y_px = static_cast<float>(rng.uniform(80, 340));
    his.to.x_px = his.from.x_px + 30;
    points.push_back(his);
  }
  EXPECT_LT(turn_deg(points, HeadingMethod::kNaive), -2);
  EXPECT_NEAR(turn_deg(points, HeadingMethod::kRegions), 1, 0.15);
  EXPECT_NEAR(turn_deg(points, HeadingMethod::kEpipolar), 1, 0.15);
}

TEST(Turn, TakesRollAndPitchForWhatTheyAre) {
  const CameraMove move{.turn_rad = 0.8 / kDegrees,
                        .pitch_rad = 0.7 / kDegrees,
                        .roll_rad = -1.5 / kDegrees,
                        .travel_m = {0, 0.01, 0.2}};
  EXPECT_NEAR(
      turn_deg(tracked_points(kCamera, move, 300, test_support::anywhere, 0.3), HeadingMethod::kEpipolar),
      0.8, 0.05);
}

TEST(Turn, SaysWhatTravelToTheSideWouldMakeOfIt) {
  // The walker goes 5 degrees to the right of where the camera looks.
  const double side_rad = 5 / kDegrees;
  const CameraMove move{.turn_rad = 0.5 / kDegrees,
                        .travel_m = {0.2 * std::sin(side_rad), 0, 0.2 * std::cos(side_rad)}};
  const auto turned = vo::turn(tracked_points(kCamera, move, 400, test_support::anywhere, 0.1), kCamera);
  ASSERT_TRUE(turned && turned->travel_rad);
  EXPECT_NEAR(*turned->travel_rad * kDegrees, 5, 1);  // one frame's answer
  const double as_if_ahead = std::abs(turned->turn_rad * kDegrees - 0.5);
  EXPECT_GT(as_if_ahead, 0.05);
  EXPECT_LT(std::abs((turned->turn_rad + turned->turn_per_travel * side_rad) * kDegrees - 0.5),
            as_if_ahead / 3);
}

TEST(Turn, StandingTellsNoDirectionOfTravel) {
  const auto turned =
      vo::turn(tracked_points(kCamera, {.turn_rad = 0.01}, 200, test_support::anywhere, 0.2), kCamera);
  ASSERT_TRUE(turned);
  EXPECT_NEAR(turned->turn_rad, 0.01, 0.0005);
  EXPECT_FALSE(turned->travel_rad);
}

TEST(Turn, NeedsPoints) {
  const auto points = tracked_points(kCamera, {}, 7);
  for (const auto method : {HeadingMethod::kNaive, HeadingMethod::kRegions, HeadingMethod::kEpipolar}) {
    EXPECT_FALSE(vo::turn({}, kCamera, {.method = method}));
    EXPECT_FALSE(vo::turn(points, kCamera, {.method = method}));
    EXPECT_TRUE(vo::turn(points, kCamera, {.method = method, .min_points = 7}));
    // One point many times over: nothing moved, no direction.
    const auto same = vo::turn(std::vector<vo::TrackedPoint>(20), kCamera, {.method = method});
    ASSERT_TRUE(same);
    EXPECT_EQ(same->turn_rad, 0);
  }
  EXPECT_THROW(vo::turn(points, kCamera, {.strips = 0}), std::invalid_argument);
  EXPECT_THROW(vo::turn(points, kCamera, {.min_points = 0}), std::invalid_argument);
  EXPECT_THROW(vo::turn(points, kCamera, {.noise_px = 0}), std::invalid_argument);
}

}  // namespace
