#include "support/gait_signals.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/lowpass.hpp>
#include <vo/gait/pvo_steps.hpp>

namespace {

using test_support::GaitSignal;
using testing::ElementsAre;
using testing::IsEmpty;
using vo::Leg;

/// A signal with an extremum of each value at frames 1, 3, 5, ..., and 0 between them, at 10 Hz.
std::vector<double> extrema(const std::vector<double>& values) {
  std::vector<double> signal{0};
  for (const double value : values) {
    signal.push_back(value);
    signal.push_back(0);
  }
  return signal;
}

vo::StepDetection detect(const std::vector<double>& signal, const vo::PublishedStepOptions& options) {
  std::vector<double> time_s;
  for (std::size_t i = 0; i < signal.size(); ++i) time_s.push_back(static_cast<double>(i) / 10);
  return vo::detect_steps_as_published(signal, time_s, options);
}

std::vector<double> values_of(const vo::StepDetection& found) {
  std::vector<double> values;
  for (const vo::Step& step : found.steps) values.push_back(step.value);
  return values;
}

TEST(DetectStepsAsPublished, TakesPeaksAboveZeroForLeftStepsAndValleysBelowForRightOnes) {
  // Peaks at frames 1 and 5 (a plateau), a valley at 3, a peak below 0 at 8, a valley above 0 at 11.
  const auto found = detect({0, 2, 0, -2, 0, 2, 2, -3, -1, -3, 3, 1, 3, 0}, {.delta_min = 0});
  std::vector<std::size_t> frames;
  for (const vo::Step& step : found.steps) frames.push_back(step.frame);
  EXPECT_THAT(frames, ElementsAre(1, 3, 5, 7, 10));  // of each equal pair the first
  EXPECT_EQ(found.steps[0].leg, Leg::kLeft);
  EXPECT_EQ(found.steps[1].leg, Leg::kRight);
  EXPECT_EQ(found.steps[3].time_s, 0.7);
  EXPECT_EQ(found.bridged, 0U);
}

TEST(DetectStepsAsPublished, LeavesOutWhatIsBelowTheStaticThreshold) {
  // A value that is delta_min is not below it.
  EXPECT_THAT(values_of(detect(extrema({0.9, -0.9, 1, -1}), {.delta_min = 1})), ElementsAre(1, -1));
}

TEST(DetectStepsAsPublished, KeepsTheLargerOfTwoByOneLegHoweverFarApart) {
  EXPECT_THAT(values_of(detect(extrema({4, 5, 4.5, -4, -3.9, 4}), {.delta_min = 0.1})),
              ElementsAre(5, -4, 4));
  std::vector<double> far = extrema({4, -4, 4});
  far.resize(1000, 0);  // 99 s of nothing
  far.insert(far.end(), {5, 0, -5, 0});
  EXPECT_THAT(values_of(detect(far, {.delta_min = 0.1})), ElementsAre(4, -4, 5, -5));
}

TEST(DetectStepsAsPublished, DynamicThresholdIsAQuarterOfTheMedianOfFourDifferences) {
  // Steps 1 -3 5 -7 9 differ by 4 8 12 16: at the next extremum delta_dyn is 10 / 4; with the last five of
  // 1 -3 5 -7 9 -11, by 8 12 16 20: 14 / 4.
  const auto found = detect(extrema({1, -3, 5, -7, 9, -11, 3.5, -3.6, 3.6}), {.delta_min = 0});
  EXPECT_EQ(found.delta_dyn[1], 0);
  EXPECT_EQ(found.delta_dyn[3], 0);     // one step makes no difference
  EXPECT_EQ(found.delta_dyn[5], 1);     // 4 / 4
  EXPECT_EQ(found.delta_dyn[7], 1.5);   // (4 + 8) / 2 / 4
  EXPECT_EQ(found.delta_dyn[9], 2);     // 8 / 4
  EXPECT_EQ(found.delta_dyn[11], 2.5);  // (8 + 12) / 2 / 4
  EXPECT_EQ(found.delta_dyn[13], 3.5);  // (12 + 16) / 2 / 4: 3.5 is not greater, so no step
  // -3.6 is by the same leg as -11 and smaller; 3.6 is a step.
  EXPECT_THAT(values_of(found), ElementsAre(1, -3, 5, -7, 9, -11, 3.6));
}

TEST(DetectStepsAsPublished, DynamicThresholdIsUpdatedOnlyOutsideTheStaticOne) {
  // 0.5 is below delta_min, so that the threshold is the one before it.
  const auto found = detect(extrema({4, -4, 0.5, -0.5, 4}), {.delta_min = 1});
  EXPECT_EQ(found.delta_dyn[5], 0);
  EXPECT_EQ(found.delta_dyn[7], 0);
  EXPECT_EQ(found.delta_dyn[9], 2);
}

TEST(DetectStepsAsPublished, WithoutTheStaticThresholdAStandBreedsSteps) {
  // PVO Fig. 3: 30 steps between two stands of 6 s, in which the camera trembles by a tenth of a step.
  const GaitSignal walk = GaitSignal(5).stand(6, 0.02, 0.15).walk(30, 1.9, 1, 0.1).stand(6, 0.02, 0.15);
  const auto signal = vo::lowpass_zero_phase(walk.deg(), GaitSignal::kRate_hz);
  const auto without = vo::detect_steps_as_published(signal, walk.time_s(), {.delta_min = 0});
  const auto with = vo::detect_steps_as_published(signal, walk.time_s(), {.delta_min = 0.25});
  const auto learned = vo::detect_steps_as_published(signal, walk.time_s());
  // Fig. 3a: the tremble before the first step is one step a second or more, as nothing is known of steps
  // yet.
  const auto before = [](const vo::StepDetection& found) {
    return std::ranges::count_if(found.steps, [](const vo::Step& step) { return step.time_s < 6; });
  };
  EXPECT_GE(before(without), 6);
  EXPECT_GT(without.steps.size(), 35U);
  EXPECT_EQ(before(with), 0);
  EXPECT_EQ(with.steps.size(), 30U);  // Fig. 3b
  EXPECT_EQ(learned.steps.size(), 30U);
  // A sinusoid of the signal's power: its first harmonic of 1 and its second of 0.2.
  EXPECT_NEAR(*learned.delta_min, 0.25, 0.04);
}

TEST(DetectStepsAsPublished, OfNothing) {
  EXPECT_THAT(detect({}, {}).steps, IsEmpty());
  EXPECT_THAT(detect({1}, {}).steps, IsEmpty());
  EXPECT_THAT(detect({1, 1, 1, 1}, {}).steps, IsEmpty());
  EXPECT_EQ(detect({0, 1, 0, 1, 0, 1}, {}).delta_min, 0);  // too short to show gait
  EXPECT_THROW(detect({0, 1, 0}, {.delta_min = -1}), std::invalid_argument);
  EXPECT_THROW(detect({0, 1, 0}, {.last_steps = 1}), std::invalid_argument);
  EXPECT_THROW(vo::detect_steps_as_published(std::vector<double>{1, 2}, std::vector<double>{0}),
               std::invalid_argument);
}

}  // namespace
