#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/footfall.hpp>
#include <vo/gait/walker.hpp>

namespace {

using testing::Each;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kRate_hz = 25;

/// So many seconds of a picture that grows by so much a second.
vo::GaitSignal growing(double seconds, double growth_per_s) {
  vo::GaitSignal signal{.rate_hz = kRate_hz};
  signal.shift.unit = signal.bounce.unit = vo::SignalUnit::kPixels;
  for (int i = 0; i < seconds * kRate_hz; ++i) {
    signal.time_s.push_back(i / kRate_hz);
    signal.growth_per_s.push_back(growth_per_s);
    signal.reliable.push_back(true);
    signal.matches.push_back(200);
    signal.orientation.values.push_back(0);
    signal.shift.values.push_back(0);
    signal.bounce.values.push_back(0);
  }
  return signal;
}

/// Two steps a second of a foot walker who bounces, and leans so far.
vo::GaitSignal walking(double seconds, double lean_deg) {
  vo::GaitSignal signal = growing(seconds, 0.1);
  for (std::size_t i = 0; i < signal.time_s.size(); ++i) {
    const double phase = 2 * std::numbers::pi * signal.time_s[i];  // of the stride
    signal.orientation.values[i] = lean_deg * std::sin(phase);
    signal.bounce.values[i] = -2 * std::cos(2 * phase);
  }
  return signal;
}

/// A car on a road: bumps at random times, after each of which it swings out on its springs, at 1.5 Hz and
/// a fifth of the critical damping; it leans
/// with other bumps.
vo::GaitSignal driving(double seconds, std::uint64_t seed) {
  vo::GaitSignal signal = growing(seconds, 0.3);
  vo::Rng rng(seed);
  const auto swing_out = [&](std::vector<double>& values, double size, double hz) {
    for (double bump_s = 0; bump_s < seconds; bump_s += rng.uniform(0.5, 2.5)) {
      const double height = rng.uniform(0.5, 1) * size;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const double since_s = signal.time_s[i] - bump_s;
        if (since_s > 0)
          values[i] += height * std::exp(-2 * since_s) * std::sin(2 * std::numbers::pi * hz * since_s);
      }
    }
  };
  swing_out(signal.bounce.values, 1, 1.5);
  swing_out(signal.orientation.values, 0.2, 1.1);
  swing_out(signal.shift.values, 0.5, 0.9);
  return signal;
}

std::vector<bool> walker(const vo::GaitSignal& signal) {
  return vo::bounces_like_walker(signal, vo::bounce_windows(signal.bounce.values, signal.time_s));
}

TEST(GetsOn, WhereThePictureGrowsOrShrinks) {
  EXPECT_THAT(vo::camera_travels(growing(20, 0.05)), Each(true));
  EXPECT_THAT(vo::camera_travels(growing(20, -0.05)), Each(true));
  EXPECT_THAT(vo::camera_travels(growing(20, 0.005)), Each(false));
  EXPECT_THAT(vo::camera_travels({}), IsEmpty());
}

TEST(GetsOn, NotWhereSwayComesBack) {
  // Ten centimetres to and fro in front of things 2 m off: up to 15 % a second.
  vo::GaitSignal signal = growing(30, 0);
  for (std::size_t i = 0; i < signal.time_s.size(); ++i)
    signal.growth_per_s[i] = 0.15 * std::sin(2 * std::numbers::pi * 0.8 * signal.time_s[i]);
  const std::vector<bool> nearer = vo::camera_travels(signal);
  // Four swings of 5 s; at the ends half a swing may be over.
  for (std::size_t i = 63; i + 63 < nearer.size(); ++i) EXPECT_FALSE(nearer[i]) << i;
}

TEST(GetsOn, IsToldWithinSeconds) {
  vo::GaitSignal signal = growing(40, 0);
  for (std::size_t i = 500; i < 1000; ++i) signal.growth_per_s[i] = 0.1;
  const std::vector<bool> nearer = vo::camera_travels(signal);
  for (std::size_t i = 0; i < 1000; ++i) {
    if (i < 500 - 63) {
      EXPECT_FALSE(nearer[i]) << i;
    }
    if (i >= 500) {
      EXPECT_TRUE(nearer[i]) << i;
    }
  }
}

TEST(BouncesAsWalker, WhereItIsEvenOrTheStrideSwings) {
  EXPECT_THAT(walker(walking(30, 0)), Each(true));  // even, and no lean
  // A bounce that is hardly like gait, with a lean.
  vo::Rng rng(3);
  vo::GaitSignal uneven = walking(30, 0.5);
  for (double& down_px : uneven.bounce.values) down_px += 1.1 * rng.normal();
  const auto windows = vo::bounce_windows(uneven.bounce.values, uneven.time_s);
  double strength = 0;
  for (const vo::Periodicity& window : windows)
    strength += window.strength / static_cast<double>(windows.size());
  ASSERT_LT(strength, 0.8);
  EXPECT_THAT(walker(uneven), Each(true));
}

TEST(BouncesAsWalker, NotWhereARoadDoesIt) {
  std::size_t like_gait = 0;
  double mistaken = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const vo::GaitSignal drive = driving(60, seed);
    for (const vo::Periodicity& window : vo::bounce_windows(drive.bounce.values, drive.time_s))
      like_gait += window.gait ? 1 : 0;
    const std::vector<bool> taken = walker(drive);
    mistaken += static_cast<double>(std::ranges::count(taken, true)) / static_cast<double>(taken.size()) / 10;
  }
  EXPECT_GT(like_gait, 100U);  // of 3000 windows: there was something to be told apart
  // Bumps come evenly by chance for some seconds of ten minutes.
  EXPECT_LE(mistaken, 0.05);
}

TEST(BouncesAsWalker, IsNotKnownWithoutGait) {
  EXPECT_THAT(walker(growing(20, 0.1)), Each(false));
  EXPECT_THAT(vo::bounces_like_walker({}, {}), IsEmpty());
}

vo::StepDetection steps_at(double hz, double seconds) {
  vo::StepDetection detection{.partial = {.first = 0.5, .after = 0.5}, .gait_share = 1};
  for (int k = 1; k <= seconds * hz; ++k) {
    const auto frame = static_cast<std::size_t>(std::lround(k / hz * kRate_hz));
    detection.steps.push_back(
        {.frame = frame, .time_s = static_cast<double>(frame) / kRate_hz, .bridged = k % 2 == 0});
  }
  return detection;
}

TEST(WalkersSteps, AreThoseWhereOneWalks) {
  std::vector<bool> walked(501, true);
  EXPECT_THAT(vo::walkers_steps(steps_at(2, 20), walked).steps, SizeIs(40));
  std::fill(walked.begin(), walked.begin() + 250, false);
  const vo::StepDetection half = vo::walkers_steps(steps_at(2, 20), walked);
  EXPECT_THAT(half.steps, SizeIs(21));
  EXPECT_EQ(half.bridged, 11U);
  EXPECT_EQ(half.partial.first, 1);
  EXPECT_EQ(half.partial.after, 0.5);
  const vo::StepDetection none = vo::walkers_steps(steps_at(2, 20), std::vector<bool>(501, false));
  EXPECT_THAT(none.steps, IsEmpty());
  EXPECT_EQ(none.gait_share, 0);
  EXPECT_EQ(none.partial.after, 0);
}

TEST(WalkersSteps, HaveACadenceOfPeople) {
  const std::vector<bool> walked(501, true);
  for (const double hz : {1.25, 2.0, 3.4})
    EXPECT_THAT(vo::walkers_steps(steps_at(hz, 20), walked).steps, Not(IsEmpty()));
  for (const double hz : {0.9, 1.1, 3.8, 5.0})
    EXPECT_THAT(vo::walkers_steps(steps_at(hz, 20), walked).steps, IsEmpty());
  // Four steps and a stand tell no cadence.
  EXPECT_THAT(vo::walkers_steps(steps_at(1.1, 4), walked).steps, SizeIs(4));
}

TEST(WalkersSteps, OfNoneAreNone) {
  EXPECT_THAT(vo::walkers_steps({}, {}).steps, IsEmpty());
  EXPECT_THROW(vo::walkers_steps(steps_at(2, 20), std::vector<bool>(10)), std::invalid_argument);
}

}  // namespace
