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
    gait.rate_hz = 25;
    gait.shift.unit = gait.bounce.unit = vo::SignalUnit::kPixels;
    for (int i = 0; i < 250; ++i) {
      gait.time_s.push_back(i / 25.0);
      const double phase = 2 * std::numbers::pi * gait.time_s.back();  // of the stride
      gait.orientation.values.push_back(orientation_deg * std::sin(phase));
      gait.shift.values.push_back(shift_px * std::sin(phase));
      // Up fastest as a foot lands, every half second; the roll is at its fastest a quarter second before.
      gait.bounce.values.push_back(-bounce_px * std::cos(2 * phase));
      gait.growth_per_s.push_back(0.25);
      gait.reliable.push_back(true);
      gait.matches.push_back(200);
    }
  }

  [[nodiscard]] vo::StepReading read(const vo::StepReadingOptions& options = {}) const {
    return vo::read_steps(gait, options);
  }

  vo::GaitSignal gait;
};

TEST(ReadSteps, TakesTheBounceWhereAllShowGait) {
  const vo::StepReading reading = Signals(0.5, 3, 2).read();
  EXPECT_EQ(reading.signal, StepSignal::kBounce);
  ASSERT_THAT(reading.detection.steps, SizeIs(19));  // the recording ends a frame before another
  EXPECT_EQ(reading.detection.steps[0].leg, vo::Leg::kLeft);
  EXPECT_NEAR(reading.detection.steps[0].time_s, 0.5, 0.05);
}

TEST(ReadSteps, TakesWhichIsLikeGaitForLonger) {
  Signals signals(0.5, 0, 2);
  for (std::size_t i = 125; i < 250; ++i) signals.gait.bounce.values[i] = 0;
  const vo::StepReading reading = signals.read();
  EXPECT_EQ(reading.signal, StepSignal::kOrientation);
  EXPECT_THAT(reading.detection.steps, SizeIs(20));  // at 0.25 s, 0.75 s, ...
}

TEST(ReadSteps, TakesTheShiftWhereNothingElseShowsSteps) {
  Signals signals(0, 3, 0);
  // Too small by half to be a step; the way goes on.
  for (std::size_t i = 125; i < 137; ++i) signals.gait.shift.values[i] /= 10;
  const vo::StepReading reading = signals.read();
  EXPECT_EQ(reading.signal, StepSignal::kShift);
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
  EXPECT_EQ(signals.read({.signal = {}, .detection = {.delta_min = 0.1}}).signal, StepSignal::kOrientation);
}

TEST(ReadSteps, FillsTheDarkByTheShiftUnlessTheOrientationWasAskedFor) {
  Signals signals(0.5, 3, 0);
  for (std::size_t i = 150; i < 250; ++i) {
    signals.gait.orientation.values[i] = 0;
    signals.gait.matches[i] = 10;
  }
  EXPECT_EQ(signals.read().signal, StepSignal::kOrientation);
  EXPECT_THAT(signals.read().detection.steps, SizeIs(20));
  EXPECT_THAT(signals.read({.signal = StepSignal::kOrientation}).detection.steps, SizeIs(12));
}

TEST(ReadSteps, FindsNoneInAStandOrNoFrames) {
  EXPECT_THAT(Signals(0, 0, 0).read().detection.steps, IsEmpty());
  EXPECT_THAT(vo::read_steps({}).detection.steps, IsEmpty());
}

TEST(ReadSteps, NeedsAWalkerWhoGetsOn) {
  Signals shaken(0.5, 3, 2);
  for (double& growth_per_s : shaken.gait.growth_per_s) growth_per_s = 0.002;
  for (const vo::StepReader& reader : vo::step_readers()) {
    if (reader.on_request) continue;
    EXPECT_THAT(reader.read(shaken.gait, {}).steps, IsEmpty()) << reader.name;
    EXPECT_EQ(reader.read(shaken.gait, {}).gait_share, 0) << reader.name;
  }
  EXPECT_THAT(shaken.read().detection.steps, IsEmpty());
}

TEST(ReadSteps, NeedASwingThatIsNoNoise) {
  // Half of what gait has at least, however even it is.
  const Signals still(0.02, 0.01, 0.01);
  for (const vo::StepReader& reader : vo::step_readers()) {
    if (reader.on_request) continue;
    EXPECT_THAT(reader.read(still.gait, {}).steps, IsEmpty()) << reader.name;
  }
  const Signals steadied(0.08, 0.04, 0.04);
  for (const vo::StepReader& reader : vo::step_readers())
    EXPECT_NEAR(static_cast<double>(reader.read(steadied.gait, {}).steps.size()), 20, 1) << reader.name;
}

TEST(StepReaders, ReadTheSignalThatTheyName) {
  const Signals signals(1, 2, 3);
  for (const StepSignal signal : {StepSignal::kOrientation, StepSignal::kBounce, StepSignal::kShift}) {
    const vo::StepReader& reader = vo::reader_of(signal);
    EXPECT_EQ(reader.signal, signal);
    // Whatever the others are.
    Signals alone(0, 0, 0);
    alone.gait.*reader.values = signals.gait.*reader.values;
    EXPECT_NEAR(static_cast<double>(reader.read(alone.gait, {}).steps.size()), 20, 1) << reader.name;
    EXPECT_EQ(alone.read().signal, signal);
  }
  EXPECT_THAT(vo::step_readers(), SizeIs(4));
}

TEST(StepReaders, TheMethodAsPublishedIsReadOnRequestAndKnowsNoWalker) {
  // Nothing gets nearer, so that none of ours finds a step; the noise of a still camera is enough for PVO.
  Signals shaken(0.5, 3, 2);
  for (double& growth_per_s : shaken.gait.growth_per_s) growth_per_s = 0;
  EXPECT_THAT(shaken.read().detection.steps, IsEmpty());
  EXPECT_THAT(shaken.read({.signal = StepSignal::kPublished}).detection.steps, SizeIs(20));
  const Signals still(0.02, 0.01, 0.01);
  const vo::StepReading with_threshold =
      still.read({.signal = StepSignal::kPublished, .detection = {.delta_min = 0.03}});
  EXPECT_EQ(with_threshold.signal, StepSignal::kPublished);
  EXPECT_THAT(with_threshold.detection.steps, IsEmpty());
}

}  // namespace
