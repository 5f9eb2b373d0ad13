#include "simulate/timetable.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace simulate {
namespace {

double mean_speed(const Timetable& table, double from_share, double to_share) {
  const double a = table.duration_s() * from_share, b = table.duration_s() * to_share;
  return (table.at(b).walked_m - table.at(a).walked_m) / (b - a);
}

TEST(Timetable, ArrivesAndNeverTurnsBackOrJumps) {
  const Walker walker = draw_walker(2);
  for (const Speed speed :
       {Speed::kSteady, Speed::kSlowFast, Speed::kFastSlow, Speed::kVaried, Speed::kStops, Speed::kRun}) {
    const Timetable table(speed, 50, walker, 9);
    EXPECT_DOUBLE_EQ(table.at(table.duration_s()).walked_m, 50);
    EXPECT_DOUBLE_EQ(table.at(0).walked_m, 0);
    for (double t = 0; t < table.duration_s(); t += 0.1) {
      const auto a = table.at(t), b = table.at(t + 0.1);
      EXPECT_GE(b.walked_m, a.walked_m);
      EXPECT_GE(b.steps, a.steps);
      // 0.8 m/s2; the last creeping step before a stand ends at once from 0.1 m/s.
      EXPECT_LE(std::abs(b.speed_mps - a.speed_mps), 0.08 + 0.101);
    }
  }
}

TEST(Timetable, KeepsASteadySpeedAndCadence) {
  const Walker walker = draw_walker(2);
  const Timetable table(Speed::kSteady, 100, walker, 1);
  EXPECT_NEAR(table.duration_s(), 100 / walker.preferred_speed_mps, 0.01);
  // 140 steps whose lengths vary by 2.3 %: five standard errors of their mean are 1 %.
  EXPECT_NEAR(table.at(1e9).steps, 100 / step_length_m(walker, walker.preferred_speed_mps), 1.5);
}

TEST(Timetable, HasTheOppositeProfilesOfSss) {
  const Walker walker = draw_walker(2);
  const Timetable slow_fast(Speed::kSlowFast, 100, walker, 1), fast_slow(Speed::kFastSlow, 100, walker, 1);
  EXPECT_NEAR(mean_speed(slow_fast, 0, 0.3), 0.95, 0.01);
  EXPECT_NEAR(mean_speed(slow_fast, 0.9, 1), 2.2, 0.01);
  EXPECT_NEAR(mean_speed(fast_slow, 0, 0.1), 2.2, 0.01);
  EXPECT_NEAR(mean_speed(fast_slow, 0.7, 1), 0.95, 0.01);
}

TEST(Timetable, StandsWithoutSteppingAtStops) {
  const Timetable table(Speed::kStops, 60, draw_walker(2), 3);
  double standing_s = 0;
  for (double t = 0; t < table.duration_s(); t += 0.1) {
    if (table.at(t).speed_mps > 0) continue;
    standing_s += 0.1;
    EXPECT_EQ(table.at(t).steps, table.at(t + 0.004).steps);
  }
  EXPECT_GT(standing_s, 6);  // at the beginning, at the end and at least once between
  EXPECT_EQ(table.at(1).walked_m, 0);
}

TEST(Timetable, RunsFaster) {
  const Timetable table(Speed::kRun, 50, draw_walker(2), 3);
  EXPECT_NEAR(mean_speed(table, 0, 1), 2.7, 0.01);
  EXPECT_NEAR(table.at(1e9).steps / table.duration_s(), 2.73, 0.1);  // about 160 steps a minute
}

TEST(Timetable, RefusesNoWay) {
  EXPECT_THROW(Timetable(Speed::kSteady, 0, draw_walker(2), 3), std::invalid_argument);
}

}  // namespace
}  // namespace simulate
