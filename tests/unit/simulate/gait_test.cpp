#include "simulate/gait.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace simulate {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Gait, StepsAsPeopleDo) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Walker walker = draw_walker(seed);
    // 0.7 m at 1.35 m/s; 5 % of walk ratio between people are 2.5 % of step length.
    EXPECT_NEAR(step_length_m(walker, 1.35), 0.70, 0.02);
    EXPECT_NEAR(1.35 / step_length_m(walker, 1.35), 1.93, 0.06);
    EXPECT_LT(step_length_m(walker, 0.8), step_length_m(walker, 2.5));
    double sum = 0;
    for (int i = 0; i < 1000; ++i) sum += step_variation(walker, i);
    EXPECT_NEAR(sum / 1000, 1, 5 * 0.0231 / std::sqrt(1000));  // five standard errors
  }
}

TEST(Gait, SwingsAtStrideAndStepFrequency) {
  const Walker walker = draw_walker(4);
  constexpr double kTime_s = 3;  // breathing and balance follow the time, not the steps
  const Swing a = swing_at(walker, 10.3, 1.3, kTime_s), step = swing_at(walker, 11.3, 1.3, kTime_s),
              stride = swing_at(walker, 12.3, 1.3, kTime_s), rest = swing_at(walker, 10.3, 0, kTime_s);
  EXPECT_NEAR(a.pitch_rad, step.pitch_rad, 1e-12);
  EXPECT_NEAR(a.up_m, step.up_m, 1e-12);
  EXPECT_NEAR(a.yaw_rad - rest.yaw_rad, -(step.yaw_rad - rest.yaw_rad), 1e-12);
  EXPECT_NEAR(a.right_m - rest.right_m, -(step.right_m - rest.right_m), 1e-12);
  EXPECT_NEAR(a.roll_rad, stride.roll_rad, 1e-12);
  EXPECT_GT(std::abs(a.roll_rad - step.roll_rad), 0.1 * kDegree);
}

double roll_range(const Walker& walker, double speed_mps) {
  double low = 1, high = -1;
  for (double steps = 0; steps < 2; steps += 0.01) {
    const double roll = swing_at(walker, steps, speed_mps, 0).roll_rad;
    low = std::min(low, roll);
    high = std::max(high, roll);
  }
  return high - low;
}

TEST(Gait, SwingsMoreTheFasterAndNotAtRest) {
  const Walker walker = draw_walker(4);
  EXPECT_NEAR(roll_range(walker, 0), 0, 1e-12);
  EXPECT_GT(roll_range(walker, 0.9), roll_range(walker, 0.3));
  EXPECT_GT(roll_range(walker, 2.7), roll_range(walker, 1.3));
  EXPECT_LT(roll_range(walker, 2.7), 10 * kDegree);
}

TEST(Gait, BreathesAtRest) {
  const Walker walker = draw_walker(4);
  EXPECT_GT(std::abs(swing_at(walker, 0, 0, 0.5).pitch_rad - swing_at(walker, 0, 0, 2.5).pitch_rad),
            0.1 * kDegree);
}

TEST(Gait, WandersLittleAndSmoothly) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Walker walker = draw_walker(seed);
    for (double s = 0; s < 100; s += 0.5) {
      const Wander a = wander_at(walker, s), b = wander_at(walker, s + 0.5);
      EXPECT_LE(std::abs(a.right_m), 0.21);  // three waves of 0.07 m
      EXPECT_LE(std::abs(a.yaw_rad), 4.2 * kDegree + 1e-12);
      EXPECT_LE(std::abs(b.right_m - a.right_m), 0.05);
    }
  }
}

}  // namespace
}  // namespace simulate
