#include "odometry_sweep_table.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Errors at 10, 50, 75 and 100 m; no walk reaches the last.
place::OdometrySweepRow row(const std::string& value, double euclidean_m, double heading_deg) {
  place::OdometrySweepRow row;
  row.value = value;
  row.steps = 40;
  for (const double at_m : {10.0, 50.0, 75.0, 100.0}) {
    place::OdometryErrors errors;
    errors.at_m = at_m;
    errors.count = at_m < 100 ? 25 : 0;
    errors.euclidean_mean_m = euclidean_m;
    errors.euclidean_sd_m = 0.5;
    errors.heading_mean_deg = heading_deg;
    errors.heading_sd_deg = 1;
    errors.heading_abs_mean_deg = 3;
    row.evaluation.errors.push_back(errors);
  }
  return row;
}

TEST(OdometrySweepTable, ComparesEveryValueWithTheFirst) {
  std::vector<place::OdometrySweepRow> rows{row("1", 2, -4), row("5", 1.5, 1)};
  rows[1].step_errors.emplace();
  rows[1].step_errors->pct = 2.5;
  const std::vector<std::string> csv = lines_of(retrace::odometry_sweep_csv("tracking-window", rows));
  ASSERT_THAT(csv, SizeIs(1 + 2 * 3));  // no row of 100 m
  EXPECT_THAT(csv[0], StartsWith("tracking-window,at_m,measurements,steps_estimated,step_error_pct,"));
  EXPECT_EQ(std::ranges::count(csv[0], ','), std::ranges::count(csv[1], ','));
  EXPECT_EQ(csv[1], "1,10,25,40,,2.000000,0.500000,-4.000000,1.000000,3.000000,0.000,0.000,0.000,0.000");
  // A quarter less far off, and 3 degrees less turned.
  EXPECT_EQ(csv[4],
            "5,10,25,40,2.5000,1.500000,0.500000,1.000000,1.000000,3.000000,25.000,0.000,-3.000,0.000");
}

TEST(OdometrySweepTable, ShowsFiftyMetresAndTheLastDistanceReached) {
  const std::vector<std::string> table =
      lines_of(retrace::odometry_sweep_table("tracking-window", {row("1", 2, -4), row("5", 1.5, 1)}));
  ASSERT_THAT(table, SizeIs(1 + 2 + 2));
  EXPECT_THAT(table[0], AllOf(HasSubstr("tracking-window"), HasSubstr("E-STD")));
  EXPECT_THAT(table[1], HasSubstr(" 1    50           25     2.00 +- 0.50"));
  EXPECT_THAT(table[2], HasSubstr(" 5    50           25     1.50 +- 0.50"));
  EXPECT_THAT(table[3], HasSubstr(" 1    75 "));
  EXPECT_THAT(table[4], AllOf(HasSubstr(" 5    75 "), HasSubstr("25.0"), HasSubstr("-3.0")));
}

}  // namespace
