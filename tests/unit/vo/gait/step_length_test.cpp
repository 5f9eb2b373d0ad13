#include <numeric>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/step_length.hpp>

namespace {

using testing::DoubleEq;
using testing::Each;
using testing::IsEmpty;

/// Steps at these times; nothing else of them matters.
std::vector<vo::Step> steps_at(const std::vector<double>& time_s) {
  std::vector<vo::Step> steps;
  for (const double s : time_s)
    steps.push_back({.frame = 0, .time_s = s, .leg = vo::Leg::kLeft, .value = 0, .bridged = false});
  return steps;
}

TEST(CalibratedStepLength, IsDistanceOverSteps) {
  EXPECT_DOUBLE_EQ(vo::calibrated_step_length_m(7.2, 10), 0.72);
  EXPECT_DOUBLE_EQ(vo::calibrated_step_length_m(7.35, 10.5), 0.7);
  EXPECT_THROW(vo::calibrated_step_length_m(0, 10), std::invalid_argument);
  EXPECT_THROW(vo::calibrated_step_length_m(7.2, 0), std::invalid_argument);
}

TEST(StepLengths, FixedAreAllAlike) {
  EXPECT_THAT(
      vo::step_lengths_m(steps_at({0, 1, 1.5, 9}), {.model = vo::StepLengthModel::kFixed, .length_m = 0.8}),
      Each(0.8));
}

TEST(StepLengths, ByCadenceWorkedExample) {
  // Four steps at 2 a second, a pause, two at 1.75; measured at 2 a second.
  const auto lengths = vo::step_lengths_m(steps_at({0, 0.5, 1, 1.5, 8, 8 + 1 / 1.75}),
                                          {.length_m = 0.8, .reference_cadence_hz = 2});
  ASSERT_EQ(lengths.size(), 6U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(lengths[i], 0.8);
  for (std::size_t i = 4; i < 6; ++i) EXPECT_NEAR(lengths[i], 0.7, 1e-12);  // rounding
}

TEST(StepLengths, UnevenLegsHaveOneCadence) {
  // Left after 0.4 s, right after 0.6 s: every stride takes 1 s, but for the ends all steps are alike.
  const auto lengths = vo::step_lengths_m(steps_at({0, 0.4, 1, 1.4, 2, 2.4, 3, 3.4, 4}),
                                          {.length_m = 0.7, .reference_cadence_hz = 2});
  for (std::size_t i = 2; i < 7; ++i) EXPECT_NEAR(lengths[i], 0.7, 1e-12);  // rounding
}

TEST(StepLengths, WithoutAReferenceAreTheLengthOnAverage) {
  std::vector<double> time_s{0};
  for (int i = 0; i < 50; ++i) time_s.push_back(time_s.back() + 0.62);
  for (int i = 0; i < 70; ++i) time_s.push_back(time_s.back() + 0.46);
  const auto lengths = vo::step_lengths_m(steps_at(time_s), {.length_m = 0.72});
  EXPECT_NEAR(std::accumulate(lengths.begin(), lengths.end(), 0.0), 0.72 * 121, 1e-9);  // rounding
  // Cadences 1 / 0.62 lies below the bound of 98 / min, 1 / 0.46 within.
  EXPECT_NEAR(lengths[100] / lengths[10], 1 / 0.46 / (98.0 / 60), 1e-9);
}

TEST(StepLengths, StayWithinTheBoundsOfCadence) {
  const vo::StepLengthOptions options{.length_m = 0.7, .reference_cadence_hz = 2};
  EXPECT_THAT(vo::step_lengths_m(steps_at({0, 1, 2, 3}), options), Each(DoubleEq(0.7 * 98 / 60 / 2)));
  EXPECT_THAT(vo::step_lengths_m(steps_at({0, 0.3, 0.6, 0.9}), options), Each(DoubleEq(0.7 * 140 / 60 / 2)));
}

TEST(StepLengths, OfNoneOneAndLoneSteps) {
  EXPECT_THAT(vo::step_lengths_m({}), IsEmpty());
  EXPECT_THAT(vo::step_lengths_m(steps_at({3})), Each(0.7));
  EXPECT_THAT(vo::step_lengths_m(steps_at({3, 10, 20})), Each(0.7));
}

TEST(StepLengths, RefuseWhatMakesNoSense) {
  const auto steps = steps_at({0, 1});
  EXPECT_THROW(vo::step_lengths_m(steps, {.length_m = 0}), std::invalid_argument);
  EXPECT_THROW(vo::step_lengths_m(steps, {.reference_cadence_hz = 0}), std::invalid_argument);
  EXPECT_THROW(vo::step_lengths_m(steps, {.min_cadence_hz = 3}), std::invalid_argument);
}

}  // namespace
