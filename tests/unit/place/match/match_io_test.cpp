#include "support/temporary_folder.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/match_io.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>

namespace {

using test_support::TemporaryFolder;

std::vector<place::Match> example() {
  std::vector<place::Match> matches(3);
  matches[0].query_frame = 4;
  matches[0].query_time_s = 0.16;
  matches[0].place = {
      .traverse = "by day", .keyframe = 1, .frame = 20, .time_s = 0.8, .distance_m = 1.25, .pose = {}};
  matches[0].score = 1.0 / 3;
  matches[0].probability = 0.97;
  matches[0].sd_keyframes = 1.5;
  matches[0].sd_m = 0.75;
  matches[0].yaw_rad = -0.25;
  matches[0].lateral_m = 0.5;
  matches[0].ahead_m = -0.125;
  matches[0].nearest_place = "gate, north";
  matches[0].nearest_place_m = -2.5;
  matches[0].accepted = true;
  matches[1].query_frame = 9;
  matches[1].query_time_s = 0.36;
  matches[2].query_frame = 12;
  matches[2].query_time_s = 0.48;
  matches[2].place = {
      .traverse = "by day", .keyframe = 0, .frame = 0, .time_s = 0, .distance_m = {}, .pose = {}};
  matches[2].score = -0.5;
  return matches;
}

place::Route route() {
  place::Route route;
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.name = "by day";
  for (const int frame : {0, 20, 40}) {
    place::Keyframe& keyframe = traverse.keyframes.emplace_back();
    keyframe.frame = frame;
    keyframe.time_s = frame / 25.0;
    keyframe.distance_m = frame / 16.0;
    keyframe.pose = vo::Pose2{1.0 * frame, 0, 0};
  }
  return route;
}

TEST(MatchesCsv, HasTheColumnsOfTheContract) {
  EXPECT_EQ(place::to_csv(example()),
            "query_frame,query_time_s,traverse,reference_frame,reference_time_s,reference_distance_m,score,"
            "accepted,probability,sd_keyframes,sd_m,yaw_deg,lateral_m,ahead_m,nearest_place,nearest_place_m\n"
            "4,0.160000,by day,20,0.800000,1.25,0.333333333,1,0.97,1.5,0.75,-14.32,0.500,-0.125,"
            "\"gate, north\",-2.5\n"
            "9,0.360000,,,,,0,0,,,,,,,,\n"
            "12,0.480000,by day,0,0.000000,,-0.5,0,,,,,,,,\n");
}

TEST(MatchesCsv, ReadsBackTheSameText) {
  const TemporaryFolder folder;
  const std::string text = place::to_csv(example());
  const auto matches = place::read_matches(folder.write("matches.csv", text));
  EXPECT_EQ(place::to_csv(matches), text);
  EXPECT_FALSE(matches[1].place);
}

TEST(MatchesCsv, RefusesWhatIsNotWhole) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const char* said) {
    EXPECT_THROW_WITH(place::read_matches(folder.write("m.csv", text)), vo::Error, said);
  };
  refused("query_frame,reference_frame,score,accepted\n", "has no rows");
  refused("query_frame,reference_frame,score,accepted\n1,2,,1\n",
          "score is ''; expected a score for every match");
  refused("query_frame,reference_frame,score,accepted\n1.5,2,1,1\n", "query_frame is '1.5'");
  refused("query_frame,reference_frame,score,accepted\n1,-2,1,1\n", "reference_frame is '-2'");
  refused("query_frame,reference_frame,score,accepted\n1,2,1,yes\n", "accepted is 'yes'; expected 0 or 1");
  refused("query_frame,reference_frame,score,accepted,probability\n1,2,1,1,1.5\n", "probability is '1.5'");
  refused("query_frame,score,accepted\n1,2,1\n", "has no column 'reference_frame'");
  const std::string header = "query_frame,reference_frame,score,accepted\n";
  refused(header + "1,2,3,1\n1,2,3,1\n", "has query_frame 1 after 1; expected a row for each query keyframe");
  refused(header + "1,,,1\n", "accepts query_frame 1 without a place");
}

TEST(LocateMatches, TakesKeyframesAndPosesFromTheRoute) {
  auto matches = example();
  matches[0].place->keyframe = 77;
  place::locate(matches, route());
  EXPECT_EQ(matches[0].place->keyframe, 1U);
  EXPECT_EQ(matches[0].place->pose->x_m, 20);
  EXPECT_EQ(matches[2].place->distance_m, 0);
  EXPECT_FALSE(matches[1].place);
}

TEST(LocateMatches, RefusesPlacesThatTheRouteDoesNotHave) {
  auto matches = example();
  matches[0].place->frame = 21;
  EXPECT_THROW_WITH(place::locate(matches, route()), vo::Error,
                    "frame 21: is no keyframe of traverse 'by day'");
  matches[0].place->frame = 41;
  EXPECT_THROW_WITH(place::locate(matches, route()), vo::Error, "frame 41: is no keyframe");
  matches[0].place->traverse = "by night";
  EXPECT_THROW_WITH(place::locate(matches, route()), vo::Error, "traverse 'by night': is not on the route");
}

}  // namespace
