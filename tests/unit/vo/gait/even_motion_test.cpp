#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/even_motion.hpp>

namespace {

using testing::ElementsAre;

vo::FrameMotion moved(double orientation_deg, int window = 1) {
  return {
      .matches = 100,
      .window = window,
      .orientation_deg = orientation_deg,
      .shift_px = 2 * orientation_deg,
      .picture =
          vo::PictureMotion{.right_px = 1, .down_px = 3 * orientation_deg, .growth = 0.1, .roll_rad = 0.2},
      .turn = vo::Turn{.turn_rad = 0.01 * orientation_deg, .turn_per_travel = 0.5, .travel_rad = 0.1}};
}

TEST(EvenMotion, ChangesNothingAtAnEvenFrameRate) {
  vo::Rng rng(1);
  for (const double rate_hz : {12.5, 25.0, 30 / 1.001, 60.0}) {
    std::vector<vo::FrameMotion> motion;
    std::vector<double> time_s;
    for (int i = 0; i < 500; ++i) {
      time_s.push_back(std::round(1000 * i / rate_hz) / 1000);  // whole milliseconds
      motion.push_back(i % 50 == 0 ? vo::FrameMotion{} : moved(rng.uniform(-1, 1), std::min(i, 3)));
    }
    const vo::EvenMotion even = vo::even_motion(motion, time_s);
    ASSERT_EQ(even.motion.size(), 500U);
    EXPECT_NEAR(even.rate_hz, rate_hz, 0.01);
    for (std::size_t i = 0; i < 500; ++i) {
      ASSERT_EQ(even.motion[i].orientation_deg.has_value(), motion[i].orientation_deg.has_value()) << i;
      EXPECT_NEAR(even.time_s[i], time_s[i], 0.001);
      if (!motion[i].orientation_deg) continue;
      // A window of times in whole milliseconds is off by up to 1 ms of 1/60 s.
      EXPECT_NEAR(*even.motion[i].orientation_deg, *motion[i].orientation_deg, 0.07);
      EXPECT_NEAR(*even.motion[i].shift_px, *motion[i].shift_px, 0.14);
      EXPECT_NEAR(even.motion[i].picture->down_px, motion[i].picture->down_px, 0.2);
      EXPECT_NEAR(even.motion[i].turn->turn_rad, motion[i].turn->turn_rad, 0.001);
    }
  }
}

TEST(EvenMotion, WorkedExample) {
  // 0.1 s, then 0.2 s between frames: what moves by 2 in 0.2 s moves by 1 in 0.1 s.
  const std::vector<double> time_s{0, 0.1, 0.2, 0.3, 0.5, 0.7};
  const std::vector<vo::FrameMotion> motion{{}, moved(1), moved(1), moved(1), moved(4), moved(6)};
  const vo::EvenMotion even = vo::even_motion(motion, time_s);
  EXPECT_DOUBLE_EQ(even.rate_hz, 10);
  ASSERT_EQ(even.motion.size(), 8U);
  EXPECT_FALSE(even.motion[0].orientation_deg);
  // The frames at 0.5 and 0.7 s say what was moved from 0.3 and 0.5 s on: half a frame earlier than at 10
  // frames/s, 2 at 0.45 s and 3 at 0.65 s.
  const std::vector<double> expected{0, 1, 1, 1, 1 + 2.0 / 3, 2.25, 2.75, 3};
  for (std::size_t i = 1; i < 7; ++i)
    EXPECT_NEAR(even.motion[i].orientation_deg.value(), expected[i], 1e-9) << i;
  EXPECT_FALSE(even.motion[7].orientation_deg);  // after all that was measured
  EXPECT_NEAR(even.motion[5].turn->turn_rad, 0.0225, 1e-9);
  EXPECT_NEAR(even.motion[5].picture->down_px, 6.75, 1e-9);
}

TEST(EvenMotion, KnowsNothingOverAJumpOfTheClockNorBesideWhatWasNotSeen) {
  std::vector<double> time_s;
  std::vector<vo::FrameMotion> motion;
  for (int i = 0; i < 100; ++i) {
    time_s.push_back(i / 25.0 + (i >= 50 ? 1 : 0));
    motion.push_back(moved(1, std::min(i, 3)));
  }
  motion[20] = {};
  const vo::EvenMotion even = vo::even_motion(motion, time_s);
  ASSERT_EQ(even.motion.size(), 125U);
  for (std::size_t i = 1; i < 125; ++i) {
    // The three frames after the jump reach back over it.
    const bool seen = i != 20 && (i < 50 || i >= 78);
    EXPECT_EQ(even.motion[i].orientation_deg.has_value(), seen) << i;
  }
}

TEST(EvenMotion, RefusesWhatItCannotTake) {
  EXPECT_THROW(vo::even_motion(std::vector<vo::FrameMotion>(3), std::vector<double>{0, 1}),
               std::invalid_argument);
  EXPECT_THROW(vo::even_motion(std::vector<vo::FrameMotion>(1), std::vector<double>{0}),
               std::invalid_argument);
}

TEST(ReadAt, ReadsBetween) {
  const std::vector<double> values{1, 3, 2}, even_s{0, 1, 2};
  EXPECT_THAT(vo::read_at(values, even_s, std::vector<double>{-1, 0, 0.25, 1, 1.5, 2, 9}),
              ElementsAre(1, 1, 1.5, 3, 2.5, 2, 2));
  EXPECT_THROW(vo::read_at(values, std::vector<double>{0, 1}, values), std::invalid_argument);
  EXPECT_THROW(vo::read_at({}, {}, values), std::invalid_argument);
}

TEST(SignalAtFrames, IsReadOffAtTheirTimes) {
  vo::GaitSignal even{.rate_hz = 10, .time_s = {0, 0.1, 0.2}};
  even.orientation.values = even.shift.values = even.bounce.values = {0, 1, 2};
  even.shift.unit = even.bounce.unit = vo::SignalUnit::kPixels;
  even.growth_per_s = even.heading_rad = {0, 10, 20};
  const std::vector<vo::FrameMotion> motion{{}, moved(1)};
  const vo::GaitSignal signal = vo::signal_at_frames(even, motion, std::vector<double>{0, 0.15});
  EXPECT_THAT(signal.orientation.values, ElementsAre(0, testing::DoubleNear(1.5, 1e-9)));
  EXPECT_EQ(signal.shift.unit, vo::SignalUnit::kPixels);
  EXPECT_THAT(signal.heading_rad, ElementsAre(0, testing::DoubleNear(15, 1e-9)));
  EXPECT_THAT(signal.reliable, ElementsAre(false, true));
  EXPECT_THAT(signal.matches, ElementsAre(0, 100));
  EXPECT_EQ(signal.bridged, 0U);
}

}  // namespace
