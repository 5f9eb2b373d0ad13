#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <vo/io/time_unit.hpp>

namespace {

/// So many times, `step` apart.
std::vector<double> times(double step, int count = 100, double first = 0) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) all.push_back(first + step * i);
  return all;
}

std::string_view unit_of(double step_s, double per_second, double speed_m_s) {
  const std::vector<double> time = times(step_s * per_second);
  return vo::time_unit(time, speed_m_s * step_s * 99).name;
}

TEST(TimeUnit, IsTheOneInWhichAWalkerWalks) {
  // From 200 poses a second to one in 20 s, a stroll with pauses to a train.
  for (const double step_s : {0.005, 0.01, 1 / 30.0, 0.04, 0.1, 1.0, 2.0, 20.0}) {
    for (const double speed_m_s : {0.1, 0.7, 1.4, 10.0}) {
      EXPECT_EQ(unit_of(step_s, 1, speed_m_s), "") << step_s << " " << speed_m_s;
      EXPECT_EQ(unit_of(step_s, 1e3, speed_m_s), "milliseconds") << step_s << " " << speed_m_s;
      EXPECT_EQ(unit_of(step_s, 1e6, speed_m_s), "microseconds") << step_s << " " << speed_m_s;
      EXPECT_EQ(unit_of(step_s, 1e9, speed_m_s), "nanoseconds") << step_s << " " << speed_m_s;
    }
  }
}

TEST(TimeUnit, OfACameraThatStandsIsThatOfTheStep) {
  EXPECT_EQ(unit_of(0.04, 1, 0), "");
  EXPECT_EQ(unit_of(1, 1, 0), "");
  EXPECT_EQ(unit_of(0.1, 1e3, 0), "milliseconds");
  EXPECT_EQ(unit_of(0.04, 1e6, 0), "microseconds");
  EXPECT_EQ(unit_of(0.04, 1e9, 0), "nanoseconds");
  // A metre in an hour is not on the way, in whatever unit.
  EXPECT_EQ(unit_of(0.04, 1, 1 / 3600.0), "");
}

TEST(TimeUnit, OfAClockThatCountsFrom1970IsThatOfItsSize) {
  EXPECT_EQ(vo::time_unit(times(0.04, 2, 1.7e9), 0).name, "");
  EXPECT_EQ(vo::time_unit(times(40, 2, 1.7e12), 0).name, "milliseconds");
  EXPECT_EQ(vo::time_unit(times(4e4, 2, 1.7e15), 0).name, "microseconds");
  EXPECT_EQ(vo::time_unit(times(4e7, 2, 1.7e18), 0).name, "nanoseconds");
}

TEST(TimeUnit, OfHardlyAnythingIsSeconds) {
  EXPECT_EQ(vo::time_unit({}, 0).name, "");
  EXPECT_EQ(vo::time_unit(times(1, 1), 5).name, "");
  EXPECT_EQ(vo::time_unit(times(0, 5), 5).name, "");
}

TEST(TimeUnit, PicturesMayBeMinutesApart) {
  const std::vector<double> time = times(300);
  EXPECT_EQ(vo::time_unit(time, 99 * 300 * 0.5, 3600).name, "");
}

}  // namespace
