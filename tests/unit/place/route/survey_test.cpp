#include "support/temporary_folder.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/geographic.hpp>
#include <place/route/survey.hpp>
#include <vo/base/error.hpp>

namespace {

using test_support::TemporaryFolder;

/// A recording of so many frames, of which only the times matter here.
vo::Walk recording(int frames, double rate_hz) {
  vo::Walk walk{.source = "walk.mp4"};
  for (int i = 0; i < frames; ++i) walk.time_s.push_back(i / rate_hz);
  return walk;
}

TEST(Survey, TruthHasOneRowForEachFrame) {
  const TemporaryFolder folder;
  const auto truth = folder.write("truth.csv",
                                  "frame,time_s,x_m,y_m,heading_deg,distance_m\n"
                                  "0,0,1,2,90,0\n1,0.5,2,2,90,1\n");
  const place::Survey survey = place::survey_from_truth(truth, recording(2, 2));
  EXPECT_EQ(survey.source, "truth.csv");
  EXPECT_TRUE(survey.surveyed);
  ASSERT_EQ(survey.pose.size(), 2U);
  EXPECT_EQ(survey.pose[1]->x_m, 2);
  EXPECT_DOUBLE_EQ(survey.pose[1]->heading_rad, std::numbers::pi / 2);
  EXPECT_EQ(survey.distance_m[1], 1);
  EXPECT_THROW_WITH(place::survey_from_truth(truth, recording(3, 2)), vo::Error,
                    "truth.csv: has 2 rows; expected 3, one for each frame of walk.mp4");
}

TEST(Survey, ATrajectoryIsReadBetweenItsPoses) {
  // North at 2 m/s for two seconds, a pose each second; frames at 2 Hz for three.
  const TemporaryFolder folder;
  const auto tum = folder.write("poses.tum",
                                "0 0 0 0 0 0 0.70710678 0.70710678\n"
                                "1 0 2 0 0 0 0.70710678 0.70710678\n"
                                "2 0 4 0 0 0 0.70710678 0.70710678\n");
  const place::Survey survey = place::survey_from_trajectory(tum, recording(7, 2));
  ASSERT_EQ(survey.pose.size(), 7U);
  for (std::size_t i = 0; i <= 4; ++i) {
    ASSERT_TRUE(survey.pose[i]) << i;
    EXPECT_DOUBLE_EQ(survey.pose[i]->y_m, static_cast<double>(i));
    EXPECT_NEAR(survey.pose[i]->heading_rad, 0, 1e-7);  // the quaternion has eight digits
    EXPECT_DOUBLE_EQ(*survey.distance_m[i], static_cast<double>(i));
  }
  EXPECT_FALSE(survey.pose[6]);
  EXPECT_FALSE(survey.distance_m[6]);
  EXPECT_THROW_WITH(place::survey_from_trajectory(
                        folder.write("late.tum", "90 0 0 0 0 0 0 1\n91 0 0 0 0 0 0 1\n"), recording(7, 2)),
                    vo::Error, "has poses from 90.000 to 91.000 s and none within the walk");
}

TEST(Survey, ATrackGivesTheRouteItsOrigin) {
  const place::GeographicOrigin begin{47, 8};
  const auto end = place::geographic_at(begin, 0, 3);
  const TemporaryFolder folder;
  const auto track =
      folder.write("walk.csv", fmt::format("time_s,lat_deg,lon_deg\n0,47,8\n2,{:.12f},{:.12f}\n",
                                           end.latitude_deg, end.longitude_deg));
  std::optional<place::GeographicOrigin> origin;
  const place::Survey survey = place::survey_from_track(track, recording(3, 1), origin);
  ASSERT_TRUE(origin);
  EXPECT_EQ(origin->latitude_deg, 47);
  // A degree's last digit, 1e-12, is a ten-millionth of a metre.
  EXPECT_NEAR(survey.pose[1]->y_m, 1.5, 1e-6);
  EXPECT_NEAR(*survey.distance_m[2], 3, 1e-6);
  // The next walk's poses are metres about the same origin.
  const auto again = folder.write("again.csv", "time_s,lat_deg,lon_deg\n0,48,8\n2,48.00001,8\n");
  const place::Survey second = place::survey_from_track(again, recording(3, 1), origin);
  EXPECT_EQ(origin->latitude_deg, 47);
  EXPECT_GT(second.pose[0]->y_m, 111000);
}

TEST(Survey, OdometryHasPosesWithoutDistances) {
  EXPECT_FALSE(place::survey_from_odometry({}));
  const auto survey = place::survey_from_odometry({{0, {1, 2, 0}}, {1, {1, 3, 0}}});
  ASSERT_TRUE(survey);
  EXPECT_FALSE(survey->surveyed);
  EXPECT_EQ(survey->source, "odometry");
  EXPECT_EQ(survey->pose[1]->y_m, 3);
  EXPECT_FALSE(survey->distance_m[1]);
}

}  // namespace
