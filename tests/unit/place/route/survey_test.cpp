#include "support/temporary_folder.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/geographic.hpp>
#include <place/route/survey.hpp>
#include <vo/base/error.hpp>
#include <vo/base/iso_time.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

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

TEST(Survey, TruthMayNotKnowAllFrames) {
  const TemporaryFolder folder;
  const std::string header = "frame,time_s,x_m,y_m,heading_deg,distance_m\n";
  const place::Survey survey = place::survey_from_truth(
      folder.write("truth.csv", header + "0,0,,,,0\n1,0.5,2,2,90,\n2,1,,,,\n"), recording(3, 2));
  EXPECT_FALSE(survey.pose[0]);
  EXPECT_TRUE(survey.pose[1]);
  EXPECT_FALSE(survey.pose[2]);
  EXPECT_EQ(survey.distance_m[0], 0);
  EXPECT_FALSE(survey.distance_m[1]);
  EXPECT_THROW_WITH(
      place::survey_from_truth(folder.write("truth.csv", header + "0,0,,,,\n1,0.5,,,,\n"), recording(2, 2)),
      vo::Error, "truth.csv: knows neither a pose nor a distance");
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

TEST(Survey, NothingIsKnownInAGap) {
  // East at 1 m/s, a pose every 0.2 s to 2 s and from 10 s.
  const TemporaryFolder folder;
  std::string tum;
  for (int i = 0; i <= 60; ++i) {
    if (i > 10 && i < 50) continue;
    tum += fmt::format("{:.1f} {:.1f} 0 0 0 0 0 1\n", 0.2 * i, 0.2 * i);
  }
  const auto file = folder.write("lost.tum", tum);
  const vo::Walk walk = recording(121, 10);
  const place::Survey survey = place::survey_from_trajectory(file, walk);
  EXPECT_TRUE(survey.pose[20]);
  EXPECT_FALSE(survey.pose[22]);  // a frame, 0.1 s, is let pass
  EXPECT_FALSE(survey.pose[98]);
  EXPECT_TRUE(survey.pose[100]);
  EXPECT_NEAR(*survey.distance_m[120], 12, 1e-9);  // straight over the gap
  EXPECT_TRUE(place::survey_from_trajectory(file, walk, {.max_gap_s = 9}).pose[60]);
  EXPECT_FALSE(place::survey_from_trajectory(file, recording(101, 100), {.max_gap_s = 0.1}).pose[10]);
  EXPECT_THROW(place::survey_from_trajectory(file, walk, {.max_gap_s = 0}), std::invalid_argument);
}

TEST(Survey, SaysIfItKnowsLittleOfTheWalk) {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 10; ++i) text += fmt::format("{} 0 {} 0 0 0 0.7071068 0.7071068\n", 0.1 * i, 0.1 * i);
  const auto file = folder.write("walk.tum", text);
  EXPECT_THAT(place::survey_from_trajectory(file, recording(15, 10)).warnings, testing::IsEmpty());
  // To 0.9 s and a frame more.
  EXPECT_THAT(place::survey_from_trajectory(file, recording(100, 10)).warnings,
              ElementsAre(HasSubstr("walk.tum: has poses at 11 of 100 frames")));
}

TEST(Survey, TruthIsInSeconds) {
  const TemporaryFolder folder;
  // Nothing is known but times, 25 frames a second in milliseconds.
  std::string text = "frame,time_s,x_m,y_m,heading_deg,distance_m\n";
  for (int i = 0; i < 50; ++i) text += fmt::format("{},{},,,,0\n", i, 40 * i);
  EXPECT_THROW_WITH(place::survey_from_truth(folder.write("truth.csv", text), recording(50, 25)), vo::Error,
                    "truth.csv: has times over 1960 s; expected seconds: walk.mp4 lasts 1.960 s");
}

TEST(Survey, AFileWithoutTimesHasOnePoseForEachFrame) {
  const TemporaryFolder folder;
  std::string kitti;
  for (int i = 0; i < 5; ++i) kitti += fmt::format("1 0 0 0 0 1 0 0 0 0 1 {}\n", i);
  const auto file = folder.write("poses.txt", kitti);
  const place::Survey survey = place::survey_from_trajectory(file, recording(5, 1));
  EXPECT_NEAR(survey.pose[4]->y_m, 4, 1e-12);
  EXPECT_NEAR(survey.pose[4]->heading_rad, 0, 1e-12);
  EXPECT_THROW_WITH(place::survey_from_trajectory(file, recording(6, 1)), vo::Error,
                    "poses.txt: has 5 poses without times; expected 6, one for each frame of walk.mp4");
}

TEST(Survey, ClocksAreMatchedWhereBothSayTheDate) {
  const TemporaryFolder folder;
  std::string tum;
  for (int i = 0; i <= 100; ++i) tum += fmt::format("{} {} 0 0 0 0 0 1\n", 1700000000 + i, i);
  const auto file = folder.write("slam.tum", tum);
  vo::Walk walk = recording(11, 1);
  EXPECT_THROW_WITH(place::survey_from_trajectory(file, walk), vo::Error, "--trajectory-start-s");
  EXPECT_EQ(place::survey_from_trajectory(file, walk, {.start_s = 1700000050}).pose[0]->x_m, 50);
  walk.start_utc_s = 1700000020;
  const place::Survey matched = place::survey_from_trajectory(file, walk);
  EXPECT_EQ(matched.pose[0]->x_m, 20);
  EXPECT_THAT(matched.warnings,
              ElementsAre(HasSubstr("the first frame is 20.0 s after the file's first pose")));
  walk.start_utc_s = 1600000000;  // a camera whose clock was never set
  EXPECT_THROW(place::survey_from_trajectory(file, walk), vo::Error);
}

TEST(Survey, ALoggerMayRunLongBeforeTheCamera) {
  const TemporaryFolder folder;
  std::string gpx = "<gpx><trk><trkseg>";
  for (int i = 0; i < 80; ++i) {
    const auto at = place::geographic_at({47, 8}, 0, i);
    gpx += fmt::format("<trkpt lat=\"{:.9f}\" lon=\"8\"><time>2024-05-31T12:{:02}:{:02}Z</time></trkpt>",
                       at.latitude_deg, i / 60, i % 60);
  }
  const auto file = folder.write("day.gpx", gpx + "</trkseg></trk></gpx>");
  vo::Walk walk = recording(11, 1);
  const auto surveyed = [&](const place::SurveyOptions& options) {
    std::optional<place::GeographicOrigin> origin = place::GeographicOrigin{47, 8};
    return place::survey_from_track(file, walk, origin, options);
  };
  const place::Survey by_default = surveyed({});
  EXPECT_NEAR(by_default.pose[0]->y_m, 0, 1e-3);
  EXPECT_THAT(by_default.warnings, ElementsAre(HasSubstr("lasts 79 s, the video 10 s")));
  const place::Survey said = surveyed({.start_s = 60});
  EXPECT_NEAR(said.pose[0]->y_m, 60, 1e-3);
  EXPECT_THAT(said.warnings, testing::IsEmpty());
  walk.start_utc_s = vo::parse_iso_time("2024-05-31T12:01:00Z");
  EXPECT_NEAR(surveyed({}).pose[0]->y_m, 60, 1e-3);
  walk.start_utc_s = vo::parse_iso_time("2024-05-31T14:01:00Z");  // local time, said to be UTC
  const place::Survey apart = surveyed({});
  EXPECT_NEAR(apart.pose[0]->y_m, 0, 1e-3);
  EXPECT_THAT(apart.warnings, testing::Contains(HasSubstr("was not recorded at the video's creation time")));
}

TEST(Survey, NoPoseLiesBetweenSegments) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "walk.gpx",
      "<gpx><trk><trkseg><trkpt lat=\"47\" lon=\"8\"><time>2024-05-31T12:00:00Z</time></trkpt>"
      "<trkpt lat=\"47.0001\" lon=\"8\"><time>2024-05-31T12:00:04Z</time></trkpt></trkseg>"
      "<trkseg><trkpt lat=\"47.0002\" lon=\"8\"><time>2024-05-31T12:00:08Z</time></trkpt>"
      "<trkpt lat=\"47.0003\" lon=\"8\"><time>2024-05-31T12:00:10Z</time></trkpt></trkseg></trk></gpx>");
  std::optional<place::GeographicOrigin> origin;
  const place::Survey survey = place::survey_from_track(file, recording(21, 2), origin);
  EXPECT_TRUE(survey.pose[8]);
  EXPECT_FALSE(survey.pose[12]);
  EXPECT_TRUE(survey.pose[16]);
  EXPECT_TRUE(survey.pose[19]);
}

TEST(Survey, AnAllDayLogIsReadInOneGo) {
  // Twelve hours, a point a second, a third of them standing: headings are found in a pass, not in a search
  // that grows with the pauses.
  const TemporaryFolder folder;
  std::string csv = "time_s,lat_deg,lon_deg\n";
  double y_m = 0;
  for (int i = 0; i < 43200; ++i) {
    y_m += i % 10800 < 7200 ? 1.4 : 0;
    csv += fmt::format("{},{:.9f},8\n", i, place::geographic_at({47, 8}, 0, y_m).latitude_deg);
  }
  std::optional<place::GeographicOrigin> origin;
  const place::Survey survey =
      place::survey_from_track(folder.write("day.csv", csv), recording(101, 1), origin, {.start_s = 10000});
  EXPECT_NEAR(survey.pose[100]->heading_rad, 0, 1e-6);
  EXPECT_EQ(survey.distance_m[100], 0);  // a pause
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

TEST(Survey, ATrackDoesNotGoBesidePosesThatAreNotGeographic) {
  const TemporaryFolder folder;
  const auto track = folder.write("walk.csv", "time_s,lat_deg,lon_deg\n0,47,8\n2,47.00001,8\n");
  place::Route route;
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.pose_source = "poses.tum";
  EXPECT_THROW_WITH(static_cast<void>(place::survey_from_track(track, recording(3, 1), route)), vo::Error,
                    "walk.csv: is geographic, and the route has poses of poses.tum that are not");
  EXPECT_FALSE(route.origin);
  traverse.surveyed = false;  // its own odometry's, which begins anywhere
  static_cast<void>(place::survey_from_track(track, recording(3, 1), route));
  ASSERT_TRUE(route.origin);
  EXPECT_EQ(route.origin->latitude_deg, 47);
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
