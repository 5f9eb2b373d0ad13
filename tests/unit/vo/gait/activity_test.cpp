#include "support/gait_signals.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/activity.hpp>
#include <vo/gait/lowpass.hpp>

namespace {

using test_support::GaitSignal;
using testing::Each;
using testing::IsEmpty;
using vo::Activity;

std::vector<Activity> activities(const GaitSignal& signal, const vo::ActivityOptions& options = {}) {
  const auto low =
      vo::lowpass_zero_phase(vo::bridge_gaps(signal.deg(), signal.reliable()), GaitSignal::kRate_hz);
  std::vector<Activity> found;
  for (const auto& second : vo::detect_activity(low, signal.time_s(), signal.reliable(), options))
    found.push_back(second.activity);
  return found;
}

TEST(DetectActivity, TellsStandingWalkingAndRunning) {
  // 10 s each: standing, walking at 1.9, running at 2.9 steps a second with a greater amplitude, standing.
  const GaitSignal signal = GaitSignal()
                                .stand(10, 0.02, 0.03)
                                .walk(19, 1.9, 0.5, 0.05)
                                .walk(29, 2.9, 0.8, 0.05)
                                .stand(10, 0.02, 0.03);
  const auto found = activities(signal);
  ASSERT_EQ(found.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    // A window of 5 s sees the change up to 2.5 s early or late.
    if (i % 10 < 1 || (i >= 17 && i <= 22) || i % 10 > 8) continue;
    const Activity expected = i < 10 || i >= 30 ? Activity::kStanding
                              : i < 20          ? Activity::kWalking
                                                : Activity::kRunning;
    EXPECT_EQ(found[i], expected) << i;
  }
}

TEST(DetectActivity, SaysHowFastAndHowFar) {
  const GaitSignal walk = GaitSignal().walk(40, 2, 0.5);
  const auto seconds = vo::detect_activity(walk.deg(), walk.time_s(), walk.reliable());
  ASSERT_EQ(seconds.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(seconds[i].time_s, static_cast<double>(i));
    EXPECT_NEAR(seconds[i].step_hz, 2, 1e-9);  // a stride is 25 frames; rounding
    // 0.5 sqrt(1.04); over a second and a half that is not whole strides, a few hundredths more or less.
    EXPECT_NEAR(seconds[i].amplitude_deg, 0.5, 0.06);
  }
}

TEST(DetectActivity, DoesNotKnowWhereThereWasNothingToSee) {
  const auto found =
      activities(GaitSignal().walk(20, 2, 0.5, 0.02).blank(10, 0.5, false).walk(20, 2, 0.5, 0.02));
  ASSERT_EQ(found.size(), 30U);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(found[i] == Activity::kUnknown, i >= 10 && i < 20) << i;
}

TEST(DetectActivity, OfEmptyShortAndConstantSignals) {
  EXPECT_THAT(vo::detect_activity({}, {}, {}), IsEmpty());
  const auto one = vo::detect_activity(std::vector<double>{1}, std::vector<double>{5}, {true});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].activity, Activity::kUnknown);
  EXPECT_EQ(one[0].time_s, 5);
  EXPECT_THAT(activities(GaitSignal().stand(20, 0, 0)), Each(Activity::kStanding));
}

TEST(DetectActivity, PassesOverSecondsWithoutFrames) {
  // A recording that halts for three seconds.
  std::vector<double> time_s;
  for (int i = 0; i < 100; ++i) time_s.push_back(i / 25.0 + (i < 50 ? 0 : 3));
  const auto seconds =
      vo::detect_activity(std::vector<double>(100, 0.0), time_s, std::vector<bool>(100, true));
  ASSERT_EQ(seconds.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_EQ(seconds[i].activity == Activity::kUnknown, i >= 2 && i < 5) << i;
}

TEST(DetectActivity, RefusesWhatMakesNoSense) {
  const std::vector<double> signal(10, 0.0), time_s(9, 0.0);
  EXPECT_THROW(vo::detect_activity(signal, time_s, std::vector<bool>(10)), std::invalid_argument);
  EXPECT_THROW(vo::detect_activity(time_s, time_s, std::vector<bool>(9), {.run_step_hz = 0}),
               std::invalid_argument);
}

}  // namespace
