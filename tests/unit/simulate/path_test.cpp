#include "simulate/path.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace simulate {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Path, RoundsARightAngle) {
  const Path path({{0, 0}, {0, 10}, {10, 10}}, 2);
  EXPECT_NEAR(path.length_m(), 8 + kPi + 8, 1e-12);  // a quarter of a circle of radius 2
  const vo::Pose2 middle = path.at(8 + kPi / 2);
  EXPECT_NEAR(middle.x_m, 2 - std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(middle.y_m, 8 + std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(middle.heading_rad, kPi / 4, 1e-12);
  const vo::Pose2 end = path.at(path.length_m());
  EXPECT_NEAR(end.x_m, 10, 1e-12);
  EXPECT_NEAR(end.y_m, 10, 1e-12);
  EXPECT_NEAR(end.heading_rad, kPi / 2, 1e-12);
}

TEST(Path, MovesByTheDistanceWalkedAndAlongItsHeading) {
  const Path path({{0, 0}, {3, 20}, {30, 25}, {31, 60}}, 3);
  constexpr double kStep_m = 1e-4;
  for (double s = -2; s < path.length_m() + 2; s += 0.37) {
    const vo::Pose2 a = path.at(s), b = path.at(s + kStep_m);
    // A chord of an arc of 3 m radius deviates from it by far less than 1e-8 over 0.1 mm.
    EXPECT_NEAR(b.x_m - a.x_m, kStep_m * std::sin(a.heading_rad), 1e-8);
    EXPECT_NEAR(b.y_m - a.y_m, kStep_m * std::cos(a.heading_rad), 1e-8);
  }
}

TEST(Path, FindsPlacesOnItsLegs) {
  const Path path({{0, 0}, {0, 10}, {10, 10}}, 2);
  const vo::Pose2 pose = path.at(path.distance_on_leg(1, 7));
  EXPECT_NEAR(pose.x_m, 7, 1e-12);
  EXPECT_NEAR(pose.y_m, 10, 1e-12);
}

TEST(Path, RefusesWhatItCannotRound) {
  EXPECT_THROW(Path({{0, 0}}, 1), std::invalid_argument);
  EXPECT_THROW(Path({{0, 0}, {0, 1}}, 0), std::invalid_argument);
  EXPECT_THROW(Path({{0, 0}, {0, 1}, {5, 1}}, 2), std::invalid_argument);
}

TEST(Path, MovesToTheRightOfTheHeading) {
  const vo::Pose2 east = moved_right({1, 1, kPi / 2}, 2);
  EXPECT_NEAR(east.x_m, 1, 1e-12);
  EXPECT_NEAR(east.y_m, -1, 1e-12);
}

}  // namespace
}  // namespace simulate
