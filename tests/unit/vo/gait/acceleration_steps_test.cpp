#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/acceleration_steps.hpp>

namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr double kGravity = 9.81;

struct Recording {
  std::vector<double> acceleration, time_s;
};

/// A recording whose phase of steps (1 for each) and amplitude depend on the time; the heel's impact is a
/// second harmonic.
template <typename Phase, typename Amplitude>
Recording recorded(double length_s, double rate_hz, const Phase& steps, const Amplitude& amplitude,
                   double noise = 0.2) {
  Recording r;
  vo::Rng rng(7);
  for (int i = 0; i < length_s * rate_hz; ++i) {
    const double t = i / rate_hz, phase = 2 * std::numbers::pi * steps(t);
    r.time_s.push_back(t);
    r.acceleration.push_back(kGravity + amplitude(t) * (std::sin(phase) + 0.6 * std::sin(2 * phase + 1)) +
                             noise * rng.normal());
  }
  return r;
}

std::vector<double> steps_of(const Recording& r) {
  return vo::acceleration_steps(r.acceleration, r.time_s);
}

TEST(AccelerationSteps, AreOneForEachImpact) {
  for (const double cadence_hz : {0.9, 1.4, 1.8, 2.3, 3.2}) {
    const auto steps = steps_of(recorded(
        30, 200, [&](double t) { return cadence_hz * t; }, [](double) { return 1.5; }));
    EXPECT_NEAR(static_cast<double>(steps.size()), 30 * cadence_hz, 1)
        << cadence_hz;  // one may be cut at an end
    // But for the first and last, where the filter has to guess what lies beyond.
    for (std::size_t i = 2; i + 1 < steps.size(); ++i)
      EXPECT_NEAR(steps[i] - steps[i - 1], 1 / cadence_hz, 0.1) << cadence_hz << " at " << steps[i];
  }
}

TEST(AccelerationSteps, FollowAPaceThatChanges) {
  // From 1.5 to 2.5 steps a second within 20 s: 40 in all.
  const auto steps = steps_of(recorded(
      20, 200, [](double t) { return 1.5 * t + 0.025 * t * t; }, [](double) { return 2.0; }));
  EXPECT_NEAR(static_cast<double>(steps.size()), 40, 1);
}

TEST(AccelerationSteps, AWalkerWhoStandsMakesNone) {
  const auto walks = [](double t) { return t < 8 || t >= 15 ? 1.5 : 0.0; };
  const auto steps = steps_of(recorded(
      23, 100, [](double t) { return 2 * t; }, walks, 0.1));
  EXPECT_NEAR(static_cast<double>(steps.size()), 32, 2);  // one may be cut at each end of the pause
  for (const double t : steps) EXPECT_TRUE(t < 8.3 || t > 14.7) << t;
  EXPECT_THAT(steps_of(recorded(
                  20, 100, [](double t) { return 2 * t; }, [](double) { return 0.0; }, 0.1)),
              IsEmpty());
}

TEST(AccelerationSteps, ShakingThatDoesNotRepeatIsNoGait) {
  EXPECT_THAT(steps_of(recorded(
                  20, 200, [](double) { return 0.0; }, [](double) { return 0.0; }, 3)),
              SizeIs(testing::Le(2U)));  // noise may repeat for a moment
}

TEST(AccelerationSteps, DoNotDependOnTheRate) {
  const auto at = [](double rate_hz) {
    return steps_of(recorded(
        30, rate_hz, [](double t) { return 1.7 * t; }, [](double) { return 1.5; }, 0));
  };
  EXPECT_NEAR(static_cast<double>(at(50).size()), static_cast<double>(at(200).size()), 1);
}

TEST(AccelerationSteps, OfNothingAreNone) {
  EXPECT_THAT(vo::acceleration_steps({}, {}), IsEmpty());
  EXPECT_THAT(vo::acceleration_steps(std::vector<double>{kGravity}, std::vector<double>{0}), IsEmpty());
  const std::vector<double> constant(400, kGravity);
  std::vector<double> time_s;
  for (int i = 0; i < 400; ++i) time_s.push_back(i / 50.);
  EXPECT_THAT(vo::acceleration_steps(constant, time_s), IsEmpty());
  EXPECT_THROW(vo::acceleration_steps(constant, std::vector<double>{0}), std::invalid_argument);
  EXPECT_THROW(vo::acceleration_steps(std::vector<double>{1, 2}, std::vector<double>{1, 1}),
               std::invalid_argument);
}

}  // namespace
