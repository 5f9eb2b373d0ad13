#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/turns.hpp>

namespace {

using testing::IsEmpty;

constexpr double kQuarter_rad = std::numbers::pi / 2, kRate_hz = 25;

/// Headings of a walk of 20 s with a turn at a constant rate.
struct Headings {
  std::vector<double> heading_rad, time_s;
};

Headings walk_with_turn(double begin_s, double end_s, double turn_rad, double sway_rad = 0) {
  Headings walk;
  for (int i = 0; i < 20 * kRate_hz; ++i) {
    const double t = i / kRate_hz;
    const double share = std::clamp((t - begin_s) / (end_s - begin_s), 0.0, 1.0);
    walk.time_s.push_back(t);
    // Strides of 1 s.
    walk.heading_rad.push_back(share * turn_rad + sway_rad * std::sin(2 * std::numbers::pi * t));
  }
  return walk;
}

TEST(FindTurns, WorkedExample) {
  // 90 degrees from 8 to 9 s. At time t, headings 1.5 s before and after differ by 30 degrees once t + 1.5 is
  // 8.333 s, and no longer once t - 1.5 is past 8.667 s.
  const Headings walk = walk_with_turn(8, 9, kQuarter_rad);
  const std::vector<vo::WalkedTurn> turns = vo::find_turns(walk.heading_rad, walk.time_s);
  ASSERT_EQ(turns.size(), 1U);
  // The reach is 37.5 frames, so headings are read up to a frame short of it, at every whole frame.
  EXPECT_NEAR(turns[0].begin_s, 6.833, 2 / kRate_hz);
  EXPECT_NEAR(turns[0].end_s, 10.167, 2 / kRate_hz);
  EXPECT_NEAR(turns[0].turn_rad, kQuarter_rad, 1e-12);
}

TEST(FindTurns, ToTheLeftAreNegative) {
  const Headings walk = walk_with_turn(8, 9, -kQuarter_rad);
  const std::vector<vo::WalkedTurn> turns = vo::find_turns(walk.heading_rad, walk.time_s);
  ASSERT_EQ(turns.size(), 1U);
  EXPECT_NEAR(turns[0].turn_rad, -kQuarter_rad, 1e-12);
}

TEST(FindTurns, ASlowTurnIsOneAndWhole) {
  // 270 degrees in 10 s: 81 degrees in any 3 s of it.
  const Headings walk = walk_with_turn(5, 15, 3 * kQuarter_rad);
  const std::vector<vo::WalkedTurn> turns = vo::find_turns(walk.heading_rad, walk.time_s);
  ASSERT_EQ(turns.size(), 1U);
  // The heading before it is read 1.5 s before 30 degrees are reached, so none of it is missed at the
  // beginning, and up to the last frame of the stretch at its end.
  EXPECT_NEAR(turns[0].turn_rad, 3 * kQuarter_rad, 1e-12);
}

TEST(FindTurns, SwayAndSlowBendsAreNone) {
  const Headings sway = walk_with_turn(8, 9, 0, 0.2);
  EXPECT_THAT(vo::find_turns(sway.heading_rad, sway.time_s), IsEmpty());
  // 90 degrees in 20 s: 13.5 in any 3 s.
  const Headings bend = walk_with_turn(0, 20, kQuarter_rad);
  EXPECT_THAT(vo::find_turns(bend.heading_rad, bend.time_s), IsEmpty());
}

TEST(FindTurns, ToTheRightAndBackAreTwo) {
  Headings walk = walk_with_turn(6, 7, kQuarter_rad);
  const Headings back = walk_with_turn(12, 13, -kQuarter_rad);
  for (std::size_t i = 0; i < walk.heading_rad.size(); ++i) walk.heading_rad[i] += back.heading_rad[i];
  const std::vector<vo::WalkedTurn> turns = vo::find_turns(walk.heading_rad, walk.time_s);
  ASSERT_EQ(turns.size(), 2U);
  EXPECT_NEAR(turns[0].turn_rad, kQuarter_rad, 1e-12);
  EXPECT_NEAR(turns[1].turn_rad, -kQuarter_rad, 1e-12);
  EXPECT_LT(turns[0].end_s, turns[1].begin_s);
}

TEST(FindTurns, ShortInput) {
  EXPECT_THAT(vo::find_turns({}, {}), IsEmpty());
  const std::vector<double> one{1};
  EXPECT_THAT(vo::find_turns(one, one), IsEmpty());
  EXPECT_THROW(vo::find_turns(one, {}), std::invalid_argument);
}

}  // namespace
