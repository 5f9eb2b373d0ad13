#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/step_reading.hpp>

namespace {

using testing::IsEmpty;
using testing::SizeIs;
using vo::StepSignal;

/// Ten seconds at 25 frames a second of a walk at 2 steps a second, with 200 points in each frame.
struct Signals {
  Signals(double orientation_deg, double shift_px, double bounce_px) {
    for (int i = 0; i < 250; ++i) {
      time_s.push_back(i / 25.0);
      const double phase = 2 * std::numbers::pi * time_s.back();  // of the stride
      gait.filtered_orientation_deg.push_back(orientation_deg * std::sin(phase));
      gait.filtered_shift_px.push_back(shift_px * std::sin(phase));
      // Up fastest as a foot lands, every half second; the roll is at its fastest a quarter second before.
      gait.bounce_px.push_back(-bounce_px * std::cos(2 * phase));
      gait.growth.push_back(0.01);
      gait.reliable.push_back(true);
      matches.push_back(200);
    }
  }

  [[nodiscard]] vo::StepReading read(const vo::StepReadingOptions& options = {}) const {
    return vo::read_steps(gait, matches, time_s, options);
  }

  std::vector<double> time_s;
  std::vector<std::size_t> matches;
  vo::GaitSignal gait;
};

TEST(ReadSteps, TakesTheBounceWhereAllShowGait) {
  const vo::StepReading reading = Signals(0.5, 3, 2).read();
  EXPECT_EQ(reading.signal, StepSignal::kBounce);
  EXPECT_EQ(reading.stride, StepSignal::kOrientation);
  ASSERT_THAT(reading.detection.steps, SizeIs(19));  // the recording ends a frame before another
  EXPECT_EQ(reading.detection.steps[0].leg, vo::Leg::kLeft);
  EXPECT_NEAR(reading.detection.steps[0].time_s, 0.5, 0.05);
}

TEST(ReadSteps, TakesWhichIsLikeGaitForLonger) {
  Signals signals(0.5, 0, 2);
  for (std::size_t i = 125; i < 250; ++i) signals.gait.bounce_px[i] = 0;
  const vo::StepReading reading = signals.read();
  EXPECT_EQ(reading.signal, StepSignal::kOrientation);
  EXPECT_THAT(reading.detection.steps, SizeIs(20));  // at 0.25 s, 0.75 s, ...
}

TEST(ReadSteps, TakesTheShiftWhereNothingElseShowsSteps) {
  Signals signals(0, 3, 0);
  // Too small by half to be a step; the way goes on.
  for (std::size_t i = 125; i < 137; ++i) signals.gait.filtered_shift_px[i] /= 10;
  const vo::StepReading reading = signals.read();
  EXPECT_EQ(reading.signal, StepSignal::kShift);
  EXPECT_EQ(reading.stride, StepSignal::kShift);
  EXPECT_NEAR(static_cast<double>(reading.detection.steps.size()), 20, 1);  // it begins and ends within steps
  EXPECT_GT(reading.detection.bridged, 0U);
}

TEST(ReadSteps, TakesTheOneAskedFor) {
  const Signals signals(0.5, 3, 2);
  for (const StepSignal asked : {StepSignal::kOrientation, StepSignal::kBounce, StepSignal::kShift}) {
    const vo::StepReading reading = signals.read({.signal = asked});
    EXPECT_EQ(reading.signal, asked);
    EXPECT_NEAR(static_cast<double>(reading.detection.steps.size()), 20, 1);
  }
  // A threshold in degrees is one of the orientation.
  EXPECT_EQ(signals.read({.signal = {}, .detection = {.delta_min_deg = 0.1}}).signal,
            StepSignal::kOrientation);
}

TEST(ReadSteps, FillsTheDarkByTheShiftUnlessTheOrientationWasAskedFor) {
  Signals signals(0.5, 3, 0);
  for (std::size_t i = 150; i < 250; ++i) {
    signals.gait.filtered_orientation_deg[i] = 0;
    signals.matches[i] = 10;
  }
  EXPECT_EQ(signals.read().signal, StepSignal::kOrientation);
  EXPECT_THAT(signals.read().detection.steps, SizeIs(20));
  EXPECT_THAT(signals.read({.signal = StepSignal::kOrientation}).detection.steps, SizeIs(12));
}

TEST(ReadSteps, FindsNoneInAStandOrNoFrames) {
  EXPECT_THAT(Signals(0, 0, 0).read().detection.steps, IsEmpty());
  EXPECT_THAT(vo::read_steps({}, {}, {}).detection.steps, IsEmpty());
}

TEST(ValuesOf, AreThoseOfTheSignalNamed) {
  const Signals signals(1, 2, 3);
  EXPECT_EQ(vo::values_of(StepSignal::kOrientation, signals.gait), signals.gait.filtered_orientation_deg);
  EXPECT_EQ(vo::values_of(StepSignal::kShift, signals.gait), signals.gait.filtered_shift_px);
  EXPECT_EQ(vo::values_of(StepSignal::kBounce, signals.gait), signals.gait.bounce_px);
}

}  // namespace
