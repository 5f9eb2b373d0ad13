#include "support/gait_signals.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/lowpass.hpp>
#include <vo/gait/step_detection.hpp>

namespace {

using test_support::GaitSignal;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

vo::StepDetection detect(const GaitSignal& signal, const vo::StepDetectionOptions& options = {}) {
  const auto bridged = vo::bridge_gaps(signal.deg(), signal.reliable());
  return vo::detect_steps(vo::lowpass_zero_phase(bridged, GaitSignal::kRate_hz), signal.time_s(),
                          signal.reliable(), options);
}

/// Everything the thresholds of the paper do, without what was put before them.
vo::StepDetectionOptions paper_only(double delta_min) {
  vo::StepDetectionOptions options{
      .delta_min = delta_min, .first_step_ratio = 0, .stride_ratio = 0, .max_bridged_s = 0};
  options.periodicity.min_strength = -1;
  options.periodicity.min_gait_s = 0;
  return options;
}

std::vector<double> seconds(std::size_t frames, double rate_hz) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / rate_hz;
  return time_s;
}

std::vector<std::size_t> frames_of(const vo::StepDetection& detection) {
  std::vector<std::size_t> frames;
  for (const vo::Step& step : detection.steps) frames.push_back(step.frame);
  return frames;
}

void expect_alternating(const std::vector<vo::Step>& steps) {
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_LT(steps[i - 1].frame, steps[i].frame) << i;
    EXPECT_NE(steps[i - 1].leg, steps[i].leg) << i;
  }
}

TEST(DetectSteps, WorkedExample) {
  // At 8 Hz a stride every 8 frames: peaks at 2, 10, 18, ..., valleys at 6, 14, ...
  std::vector<double> signal;
  for (int stride = 0; stride < 4; ++stride)
    for (const double value : {0.0, 0.5, 1.0, 0.5, 0.0, -0.5, -1.0, -0.5}) signal.push_back(value);
  // A valley above 0 splits the second peak, whose later half is the larger; the third valley is below
  // delta_min; a peak below 0 splits the fourth.
  signal[9] = 0.9;
  signal[10] = 0.7;
  signal[11] = 1.1;
  signal[21] = -0.05;
  signal[22] = -0.1;
  signal[23] = -0.05;
  signal[29] = -0.9;
  signal[30] = -0.7;
  signal[31] = -0.8;
  signal.push_back(0);
  const auto found = vo::detect_steps(signal, seconds(33, 8), std::vector<bool>(33, true), paper_only(0.2));
  EXPECT_THAT(frames_of(found), ElementsAre(2, 6, 11, 14, 18, 26, 29));
  EXPECT_EQ(found.steps[0].leg, vo::Leg::kLeft);
  EXPECT_EQ(found.steps[1].leg, vo::Leg::kRight);
  EXPECT_EQ(found.steps[2].value, 1.1);
  EXPECT_EQ(found.steps[2].time_s, 11 / 8.0);
  EXPECT_EQ(found.delta_min, 0.2);
  EXPECT_EQ(found.bridged, 0U);
}

TEST(DetectSteps, DynamicThresholdByHand) {
  // Differences of pairs 2.0 (from 1, -1), then 1.8 (-1, 0.8): thresholds of a quarter of the median, which
  // of two is their mean. The extremum of -0.3 at frame 14 is below 0.475, so no step, but above delta_min;
  // after it the threshold is as before.
  const std::vector<double> signal{0,  .5, 1,   .5,  0,   -.5, -1, -.5, 0,  .4, .8,
                                   .4, 0,  -.2, -.3, -.2, 0,   .6, .9,  .3, 0};
  const auto found = vo::detect_steps(signal, seconds(signal.size(), 8),
                                      std::vector<bool>(signal.size(), true), paper_only(0.2));
  EXPECT_THAT(frames_of(found), ElementsAre(2, 6, 10, 18));
  EXPECT_EQ(found.delta_dyn[5], 0);                // no pair yet
  EXPECT_EQ(found.delta_dyn[10], 0.5);             // |1 - -1| / 4
  EXPECT_DOUBLE_EQ(found.delta_dyn[20], 1.9 / 4);  // the median of 2.0 and 1.8 is 1.9
}

TEST(DetectSteps, FindsEveryStepOfAWalkFromAStrollToARun) {
  for (const double step_hz : {1.2, 1.9, 3.0}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const GaitSignal walk = GaitSignal(seed).walk(60, step_hz, 0.5, 0.1);
      const auto found = detect(walk);
      EXPECT_EQ(found.steps.size(), 60U) << step_hz << " Hz, " << seed;
      expect_alternating(found.steps);
      EXPECT_EQ(found.steps.front().leg, vo::Leg::kLeft);
      // A quarter of the amplitude of sin(x) + 0.2 sin(2x + 1), which is 0.5 sqrt(1.04), less what the
      // low-pass takes of it (at 3 steps/s, gains of 0.98 and 0.76), within the noise of 0.06.
      EXPECT_NEAR(*found.delta_min, 0.25 * 0.5, 0.012);
    }
  }
}

TEST(DetectSteps, FindsNoneInAStand) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto found = detect(GaitSignal(seed).stand(60, 0.05, 0.1));
    EXPECT_THAT(found.steps, IsEmpty()) << seed;
    EXPECT_FALSE(found.delta_min.has_value());
  }
}

TEST(DetectSteps, FindsNoneInTheStandsOfAWalk) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    GaitSignal walk(seed);
    walk.stand(8, 0.02, 0.05)
        .walk(30, 1.9, 0.5, 0.05)
        .stand(60, 0.02, 0.05)
        .walk(20, 2.9, 0.8, 0.05)
        .stand(3, 0.02, 0.05);
    const auto found = detect(walk);
    // At each of four ends, what stands between walk and stand may look like one step more or less.
    EXPECT_NEAR(static_cast<double>(found.steps.size()), walk.steps(), 2) << seed;
    for (const vo::Step& step : found.steps) {
      // 30 steps take 15.8 s, 20 take 6.9 s; a step may be seen half a step early or late.
      const bool walking =
          (step.time_s > 7.5 && step.time_s < 24.3) || (step.time_s > 83.3 && step.time_s < 91.2);
      EXPECT_TRUE(walking) << step.time_s;
    }
  }
}

TEST(DetectSteps, FillsAShortGapWithTheStepsThatWentIntoIt) {
  for (const double blank_s : {0.5, 1.0, 2.0, 3.0}) {
    // The walk goes on behind the wall: 30 steps, as many as fit the gap at 2 a second, 30 steps.
    const int lost = static_cast<int>(2 * blank_s);
    GaitSignal walk;
    walk.walk(30, 2, 0.5, 0.02).blank(blank_s, 0.5, false);
    const bool left_next = lost % 2 == 0;
    walk.walk(30, 2, left_next ? 0.5 : -0.5, 0.02);
    const auto found = detect(walk);
    EXPECT_EQ(found.steps.size(), 60U + static_cast<unsigned>(lost)) << blank_s;
    expect_alternating(found.steps);
    EXPECT_EQ(std::ranges::count(found.steps, true, &vo::Step::bridged), static_cast<long>(found.bridged));
    // The steps next to the gap may be lost with it.
    EXPECT_GE(found.bridged, static_cast<unsigned>(lost) - 1);
    EXPECT_LE(found.bridged, static_cast<unsigned>(lost) + 2);
    EXPECT_EQ(detect(walk, {.max_bridged_s = 0}).bridged, 0U);
  }
}

TEST(DetectSteps, DoesNotBreedStepsAtABlankWall) {
  for (const bool reliable : {false, true}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      GaitSignal walk(seed);
      walk.walk(30, 2, 0.5, 0.02).blank(15, 0.5, reliable).walk(30, 2, 0.5, 0.02);
      const auto found = detect(walk);
      // Steps near the wall's ends cannot be told from the walk's. Four seconds on, no window that reaches
      // there has more than a fifth of walking in it.
      const auto inside = std::ranges::count_if(
          found.steps, [](const vo::Step& step) { return step.time_s > 15 + 4 && step.time_s < 30 - 4; });
      EXPECT_EQ(inside, 0) << reliable << seed;
    }
  }
}

TEST(DetectSteps, DoesNotFillAGapInWhichTheWalkerStands) {
  GaitSignal walk;
  walk.walk(30, 2, 0.5, 0.01).stand(3, 0.02, 0.01).walk(30, 2, 0.5, 0.01);
  const auto found = detect(walk);
  EXPECT_EQ(found.bridged, 0U);
  EXPECT_NEAR(static_cast<double>(found.steps.size()), 60,
              1);  // one more or less at the two ends of the stand
}

TEST(DetectSteps, DependsOnTheSignalsShapeAlone) {
  const GaitSignal walk = GaitSignal(4).stand(5, 0.02, 0.05).walk(50, 1.8, 0.5, 0.1).stand(5, 0.02, 0.05);
  auto signal = vo::lowpass_zero_phase(walk.deg(), 25);
  const auto found = vo::detect_steps(signal, walk.time_s(), walk.reliable());
  for (double& value : signal) value *= -4;  // exact
  const auto mirrored = vo::detect_steps(signal, walk.time_s(), walk.reliable());
  EXPECT_EQ(frames_of(found), frames_of(mirrored));
  EXPECT_EQ(*mirrored.delta_min, 4 * *found.delta_min);
  for (std::size_t i = 0; i < found.steps.size(); ++i) EXPECT_NE(found.steps[i].leg, mirrored.steps[i].leg);
}

TEST(DetectSteps, OfEmptyShortAndConstantSignals) {
  for (const std::size_t frames : {0U, 1U, 2U, 3U, 200U}) {
    const auto found = vo::detect_steps(std::vector<double>(frames, 1.0), seconds(frames, 25),
                                        std::vector<bool>(frames, true));
    EXPECT_THAT(found.steps, IsEmpty()) << frames;
    EXPECT_EQ(found.delta_dyn.size(), frames);
    EXPECT_THAT(found.delta_dyn, Each(0));
  }
}

TEST(DetectSteps, RefusesWhatMakesNoSense) {
  const std::vector<double> signal(10, 0.0);
  const auto time_s = seconds(10, 25);
  const std::vector<bool> reliable(10, true);
  EXPECT_THROW(vo::detect_steps(signal, seconds(9, 25), reliable), std::invalid_argument);
  EXPECT_THROW(vo::detect_steps(signal, time_s, std::vector<bool>(9)), std::invalid_argument);
  EXPECT_THROW(vo::detect_steps(signal, time_s, reliable, {.delta_min = -1}), std::invalid_argument);
  EXPECT_THROW(vo::detect_steps(signal, time_s, reliable, {.delta_dyn_ratio = -1}), std::invalid_argument);
  EXPECT_THROW(vo::detect_steps(signal, time_s, reliable, {.pairs = 0}), std::invalid_argument);
  EXPECT_THROW(vo::detect_steps(signal, time_s, reliable, {.stride_ratio = -1}), std::invalid_argument);
  EXPECT_THROW(vo::detect_steps(signal, time_s, reliable, {.pause_s = 0}), std::invalid_argument);
}

}  // namespace
