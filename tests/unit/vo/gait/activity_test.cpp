#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/activity.hpp>

namespace {

using testing::IsEmpty;
using vo::Activity;

/// So many seconds at 25 frames/s in which the picture grows by so much a second.
struct Frames {
  explicit Frames(double seconds, double growth_per_s = 0.1) {
    signal.rate_hz = 25;
    for (int i = 0; i < seconds * 25; ++i) add(i / 25.0, growth_per_s, true);
  }
  void add(double time_s, double growth_per_s, bool reliable) {
    signal.time_s.push_back(time_s);
    signal.growth_per_s.push_back(growth_per_s);
    signal.reliable.push_back(reliable);
    signal.orientation.values.push_back(0);
    signal.flow_per_s.push_back({});
  }
  void set(double from_s, double to_s, double growth_per_s, bool reliable = true) {
    for (std::size_t i = 0; i < signal.time_s.size(); ++i) {
      if (signal.time_s[i] < from_s || signal.time_s[i] >= to_s) continue;
      signal.growth_per_s[i] = growth_per_s;
      signal.reliable[i] = reliable;
    }
  }
  vo::GaitSignal signal;
};

/// Steps at an even cadence, the first done `from_s + 1 / hz`, up to `to_s`.
void step(std::vector<vo::Step>& steps, double from_s, double to_s, double hz) {
  for (int k = 1; from_s + k / hz <= to_s + 1e-9; ++k)
    steps.push_back({.frame = static_cast<std::size_t>((from_s + k / hz) * 25), .time_s = from_s + k / hz});
}

std::vector<Activity> activities(const std::vector<vo::ActivitySecond>& seconds) {
  std::vector<Activity> all;
  for (const vo::ActivitySecond& second : seconds) all.push_back(second.activity);
  return all;
}

TEST(DetectActivity, IsThatOfTheSteps) {
  // 10 s each: standing, walking at 1.6, running at 2.5 steps a second, standing.
  Frames frames(40);
  frames.set(0, 10, 0);
  frames.set(30, 40, 0);
  std::vector<vo::Step> steps;
  step(steps, 10, 20, 1.6);
  step(steps, 20, 30, 2.5);
  const auto seconds = vo::detect_activity(frames.signal, steps);
  ASSERT_EQ(seconds.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(seconds[i].time_s, static_cast<double>(i));
    const Activity expected = i < 10 || i >= 30 ? Activity::kStanding
                              : i < 20          ? Activity::kWalking
                                                : Activity::kRunning;
    EXPECT_EQ(seconds[i].activity, expected) << i;
    // Within two strides of the change the cadence is that of both.
    if (i >= 10 && i < 18) {
      EXPECT_NEAR(seconds[i].step_hz, 1.6, 1e-9) << i;
    }
    if (i >= 22 && i < 30) {
      EXPECT_NEAR(seconds[i].step_hz, 2.5, 1e-9) << i;
    }
    if (i < 10 || i >= 30) {
      EXPECT_EQ(seconds[i].step_hz, 0) << i;
    }
  }
}

TEST(DetectActivity, AFewStepsReadEarlyAreNoRun) {
  // As on a real walk of two steps a second: for two seconds, at 2.5.
  Frames frames(20);
  std::vector<vo::Step> steps;
  step(steps, 0, 8, 2);
  step(steps, 8, 10, 2.5);
  step(steps, 10, 20, 2);
  for (const auto& second : vo::detect_activity(frames.signal, steps))
    EXPECT_EQ(second.activity, Activity::kWalking) << second.time_s;
  // Run for longer, it is a run; so is all of a short recording.
  steps.clear();
  step(steps, 0, 8, 2);
  step(steps, 8, 12, 2.5);
  step(steps, 12, 20, 2);
  EXPECT_EQ(vo::detect_activity(frames.signal, steps)[10].activity, Activity::kRunning);
  steps.clear();
  step(steps, 0, 2, 2.5);
  EXPECT_EQ(vo::detect_activity(Frames(2).signal, steps)[1].activity, Activity::kRunning);
}

TEST(DetectActivity, CountsWhatWasMadeOfAStepAfterTheLast) {
  Frames frames(10);
  std::vector<vo::Step> steps;
  step(steps, 0, 9, 1.25);  // the last at 8.8 s
  EXPECT_EQ(vo::detect_activity(frames.signal, steps).back().activity, Activity::kUnknown);
  EXPECT_EQ(vo::detect_activity(frames.signal, steps, {.after = 0.9}).back().activity, Activity::kWalking);
}

TEST(DetectActivity, IsRidingWhereTheCameraGetsOnWithoutSteps) {
  // Twenty seconds walked, then 40 s on a bus.
  Frames frames(60);
  std::vector<vo::Step> steps;
  step(steps, 0, 20, 2);
  const auto found = activities(vo::detect_activity(frames.signal, steps));
  for (std::size_t i = 0; i < 60; ++i) {
    // Nobody knows of the five seconds beside a step.
    const Activity expected = i < 20 ? Activity::kWalking : i < 25 ? Activity::kUnknown : Activity::kRiding;
    if (i != 25) {
      EXPECT_EQ(found[i], expected) << i;
    }
  }
  // Backwards, too.
  EXPECT_EQ(vo::detect_activity(Frames(20, -0.1).signal, {})[7].activity, Activity::kRiding);
  EXPECT_EQ(vo::detect_activity(Frames(20, 0.005).signal, {})[7].activity, Activity::kStanding);
}

TEST(DetectActivity, APauseOfTheRecordingIsNoRide) {
  // Looking around by a third of a turn, from the first picture after a pause on.
  Frames frames(120, 0);
  for (std::size_t i = 0; i < frames.signal.time_s.size(); ++i) {
    double& time_s = frames.signal.time_s[i];
    if (time_s >= 60 && time_s < 66) frames.signal.flow_per_s[i] = {0.3, 0};
    if (time_s >= 60) time_s += 120;
  }
  const auto found = activities(vo::detect_activity(frames.signal, {}));
  for (std::size_t i = 180; i < 186; ++i) EXPECT_NE(found[i], Activity::kRiding) << i;
}

TEST(DetectActivity, IsNotStandingWhileThePictureFlowsPast) {
  // Half a minute at a stop, a minute past houses, half a minute at the next stop.
  Frames frames(120, 0);
  const auto flow = [&](double from_s, double to_s, vo::Flow per_s) {
    for (std::size_t i = 0; i < frames.signal.time_s.size(); ++i)
      if (frames.signal.time_s[i] >= from_s && frames.signal.time_s[i] < to_s)
        frames.signal.flow_per_s[i] = per_s;
  };
  for (const vo::Flow past : {vo::Flow{0.3, 0}, vo::Flow{-0.3, 0.02}, vo::Flow{0, 0.3}}) {
    flow(30, 90, past);
    const auto found = activities(vo::detect_activity(frames.signal, {}));
    for (std::size_t i = 0; i < 120; ++i)
      EXPECT_EQ(found[i], i < 30 || i >= 90 ? Activity::kStanding : Activity::kRiding) << i;
  }
  // By less than a whole turn, somebody may look around.
  flow(30, 90, {});
  flow(30, 40, {0.3, 0});
  const auto around = activities(vo::detect_activity(frames.signal, {}));
  for (std::size_t i = 0; i < 120; ++i)
    EXPECT_EQ(around[i], i < 30 || i >= 40 ? Activity::kStanding : Activity::kUnknown) << i;
  // Left and right again is a glance.
  flow(30, 40, {});
  for (int second = 30; second < 90; ++second) flow(second, second + 1, {second % 2 == 0 ? 0.2 : -0.2, 0});
  EXPECT_EQ(activities(vo::detect_activity(frames.signal, {})), std::vector(120, Activity::kStanding));
}

TEST(DetectActivity, DoesNotKnowWhereThereWasNothingToSee) {
  Frames frames(30, 0);
  frames.set(10, 20, 0, false);
  const auto found = activities(vo::detect_activity(frames.signal, {}));
  for (std::size_t i = 0; i < 30; ++i)
    EXPECT_EQ(found[i], i >= 10 && i < 20 ? Activity::kUnknown : Activity::kStanding) << i;
}

TEST(DetectActivity, TakesASingleStepForNoGait) {
  const std::vector<vo::Step> steps{{.frame = 125, .time_s = 5}};
  for (const auto& second : vo::detect_activity(Frames(10, 0).signal, steps)) {
    EXPECT_EQ(second.activity, Activity::kStanding);
    EXPECT_EQ(second.step_hz, 0);
  }
}

TEST(DetectActivity, PassesOverSecondsWithoutFrames) {
  // A recording that halts for three seconds.
  Frames frames(0);
  for (int i = 0; i < 100; ++i) frames.add(i / 25.0 + (i < 50 ? 0 : 3), 0, true);
  const auto found = activities(vo::detect_activity(frames.signal, {}));
  ASSERT_EQ(found.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(found[i] == Activity::kUnknown, i >= 2 && i < 5) << i;
}

TEST(DetectActivity, SaysHowFarTheCameraLeans) {
  Frames frames(10);
  for (std::size_t i = 0; i < 250; ++i)
    frames.signal.orientation.values[i] = 0.5 * std::sin(2 * 3.14159265 * static_cast<double>(i) / 25);
  // Over a second and a half, which is not whole waves, a few hundredths more or less.
  EXPECT_NEAR(vo::detect_activity(frames.signal, {})[5].amplitude_deg, 0.5, 0.06);
}

TEST(DetectActivity, ABriefWalkMayShowTooFewStepsToSee) {
  EXPECT_EQ(activities(vo::detect_activity(Frames(2).signal, {})), std::vector(2, Activity::kUnknown));
  EXPECT_EQ(activities(vo::detect_activity(Frames(2, 0).signal, {})), std::vector(2, Activity::kStanding));
}

TEST(DetectActivity, OfEmptyAndShortWalks) {
  EXPECT_THAT(vo::detect_activity({}, {}), IsEmpty());
  Frames one(0);
  one.add(5, 0, true);
  const auto seconds = vo::detect_activity(one.signal, {});
  ASSERT_EQ(seconds.size(), 1U);
  EXPECT_EQ(seconds[0].activity, Activity::kUnknown);
  EXPECT_EQ(seconds[0].time_s, 5);
}

TEST(DetectActivity, RefusesWhatMakesNoSense) {
  EXPECT_THROW(vo::detect_activity(Frames(1).signal, {}, {}, {.run_step_hz = 0}), std::invalid_argument);
  EXPECT_THROW(vo::detect_activity(Frames(1).signal, {}, {}, {.pause_s = 0}), std::invalid_argument);
}

}  // namespace
