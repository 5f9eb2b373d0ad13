#include "support/drifting_walk.hpp"
#include "support/synthetic_walk.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/trajectory/close_loops.hpp>

namespace {

using namespace test_support;

constexpr double kStep_m = 0.1, kSide_m = 20, kRound_m = 4 * kSide_m;

/// A walk round a square block, its corners taken over 2 m, and what its odometry made of it.
struct Rounds {
  vo::Walk walk;
  vo::Trajectory truth;
  vo::WalkMotion motion;
};

/// `frames` at 10 frames/s past a wall as long as the block's walls together. Odometry turns too far by 0.3
/// degrees a metre. Frames [lost_from, lost_to) are missing, of the odometry too, and a minute with them.
Rounds rounds(std::size_t frames, std::size_t lost_from = 0, std::size_t lost_to = 0) {
  constexpr double kCorner_m = 2, kBias_rad_per_m = 0.005, kPixelsPerMetre = 24;
  constexpr auto kFramesOfRound = static_cast<std::size_t>(kRound_m / kStep_m);
  vo::Trajectory all{{0, {}}};
  for (std::size_t i = 1; i < frames; ++i) {
    const double along_m = std::fmod(kStep_m * static_cast<double>(i), kSide_m);
    const double turn_rad = along_m < kCorner_m ? std::numbers::pi / 2 * kStep_m / kCorner_m : 0;
    all.push_back({0.1 * static_cast<double>(i), advance(all.back().pose, kStep_m, turn_rad)});
  }
  Rounds made;
  std::vector<double> place_px;
  for (std::size_t i = 0; i < frames; ++i) {
    if (i >= lost_from && i < lost_to) continue;
    made.truth.push_back(all[i]);
    if (lost_to > 0 && i >= lost_to) made.truth.back().time_s += 60;
    place_px.push_back(kPixelsPerMetre * kStep_m * static_cast<double>(i % kFramesOfRound));
  }
  made.walk = Wall(static_cast<int>(kPixelsPerMetre * kRound_m), 3).walk(place_px);
  made.motion.metric = true;
  made.motion.frames.assign(made.truth.size(), {.value = kStep_m});
  made.motion.frames[0].value = 0;
  for (std::size_t i = 0; i < made.truth.size(); ++i) made.walk.time_s[i] = made.truth[i].time_s;
  made.motion.trajectory.push_back({0, {}});
  for (std::size_t i = 1; i < made.truth.size(); ++i) {
    const bool gap = lost_to > 0 && i == lost_from;
    if (gap) {
      made.motion.frames[i].value = 0;
      made.walk.gaps = {{.frame = i, .length_s = made.truth[i].time_s - made.truth[i - 1].time_s}};
    }
    const double turned_rad =
        gap ? 0 : vo::wrap_angle_rad(made.truth[i].pose.heading_rad - made.truth[i - 1].pose.heading_rad);
    made.motion.trajectory.push_back(
        {made.truth[i].time_s, advance(made.motion.trajectory.back().pose, gap ? 0 : kStep_m,
                                       turned_rad + (gap ? 0 : kBias_rad_per_m * kStep_m))});
  }
  return made;
}

/// How far a trajectory puts two visits of one place apart, in the mean over frames [from, to) of the second.
double visits_apart_m(const vo::Trajectory& trajectory, const vo::Trajectory& truth, std::size_t from,
                      std::size_t to) {
  double sum_m = 0;
  for (std::size_t i = from; i < to; ++i) {
    std::size_t first = 0;
    double least_m = 1e9;
    for (std::size_t j = 0; j < static_cast<std::size_t>(kRound_m / kStep_m); ++j) {
      const double away_m =
          std::hypot(truth[i].pose.x_m - truth[j].pose.x_m, truth[i].pose.y_m - truth[j].pose.y_m);
      if (away_m < least_m) {
        least_m = away_m;
        first = j;
      }
    }
    sum_m += std::hypot(trajectory[i].pose.x_m - trajectory[first].pose.x_m,
                        trajectory[i].pose.y_m - trajectory[first].pose.y_m);
  }
  return sum_m / static_cast<double>(to - from);
}

TEST(CloseLoops, TheSecondRoundLiesOnTheFirst) {
  const Rounds made = rounds(1400);
  const place::ClosedLoops closed = place::close_loops(made.walk, made.motion, {});
  EXPECT_GT(closed.loops, 60U);  // of 120 keyframes of the second round
  EXPECT_GE(closed.believed, closed.loops * 9 / 10);
  ASSERT_EQ(closed.trajectory.size(), made.truth.size());
  EXPECT_GT(visits_apart_m(made.motion.trajectory, made.truth, 850, 1400), 3);
  EXPECT_LT(visits_apart_m(closed.trajectory, made.truth, 850, 1400), 0.2);
}

TEST(CloseLoops, WhatWasWalkedInAGapIsLeftOpen) {
  const Rounds made = rounds(1500, 1000, 1150);  // 15 m that nobody saw
  const place::ClosedLoops closed = place::close_loops(made.walk, made.motion, {});
  EXPECT_GT(visits_apart_m(made.motion.trajectory, made.truth, 1020, 1350), 10);
  EXPECT_LT(visits_apart_m(closed.trajectory, made.truth, 1020, 1350), 0.2);
  // Taken for odometry, the gap would draw the frames beside it together, by 1 to 2 m.
  EXPECT_LT(visits_apart_m(closed.trajectory, made.truth, 970, 1000), 0.2);
  EXPECT_LT(visits_apart_m(closed.trajectory, made.truth, 1000, 1020), 0.2);
}

TEST(CloseLoops, WithoutALoopNothingChanges) {
  const Rounds made = rounds(600);
  const place::ClosedLoops closed = place::close_loops(made.walk, made.motion, {});
  EXPECT_EQ(closed.loops, 0U);
  ASSERT_EQ(closed.trajectory.size(), made.motion.trajectory.size());
  for (std::size_t i = 0; i < closed.trajectory.size(); ++i) {
    EXPECT_EQ(closed.trajectory[i].pose.x_m, made.motion.trajectory[i].pose.x_m) << i;
    EXPECT_EQ(closed.trajectory[i].pose.heading_rad, made.motion.trajectory[i].pose.heading_rad) << i;
  }
}

TEST(CloseLoops, RefusesAMotionWithoutATrajectory) {
  Rounds made = rounds(50);
  made.motion.trajectory.clear();
  EXPECT_THROW(place::close_loops(made.walk, made.motion, {}), std::invalid_argument);
}

}  // namespace
