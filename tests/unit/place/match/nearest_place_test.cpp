#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <place/match/match_io.hpp>
#include <place/match/nearest_place.hpp>

namespace {

using place::Match;

/// Eleven keyframes, 2 m and ten frames apart, with a bench at 5 m (between two keyframes) and a door at 16
/// m.
place::Route twenty_metres() {
  place::Route route;
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.name = "day";
  traverse.frames = 101;
  for (int k = 0; k <= 10; ++k) traverse.keyframes.push_back({.frame = 10 * k, .distance_m = 2.0 * k});
  traverse.places = {{"bench, \"old\"", 25, 5.0}, {"door", 80, 16.0}};
  return route;
}

Match at(std::size_t keyframe, const place::Route& route, const char* traverse = "day") {
  Match match;
  match.place = place::Place{.traverse = traverse, .keyframe = keyframe, .pose = {}};
  if (keyframe < route.traverses[0].keyframes.size())
    match.place->distance_m = route.traverses[0].keyframes[keyframe].distance_m;
  return match;
}

TEST(NearestPlace, IsTheNearestAheadOrBehindWithTheMetresToIt) {
  const place::Route route = twenty_metres();
  std::vector<Match> matches;
  for (const std::size_t k : {0U, 3U, 5U, 6U, 10U}) matches.push_back(at(k, route));
  matches.emplace_back();
  place::name_places(matches, route);
  EXPECT_EQ(matches[0].nearest_place, "bench, \"old\"");
  EXPECT_DOUBLE_EQ(*matches[0].nearest_place_m, 5);
  EXPECT_DOUBLE_EQ(*matches[1].nearest_place_m, -1);
  EXPECT_EQ(matches[2].nearest_place, "bench, \"old\"");  // 10 m: 5 behind, 6 ahead
  EXPECT_EQ(matches[3].nearest_place, "door");            // 12 m: 7 behind, 4 ahead
  EXPECT_DOUBLE_EQ(*matches[3].nearest_place_m, 4);
  EXPECT_DOUBLE_EQ(*matches[4].nearest_place_m, -4);
  EXPECT_TRUE(matches[5].nearest_place.empty());
  EXPECT_FALSE(matches[5].nearest_place_m);
}

TEST(NearestPlace, GoesByKeyframesWithoutASurvey) {
  place::Route route = twenty_metres();
  for (place::Keyframe& keyframe : route.traverses[0].keyframes) keyframe.distance_m.reset();
  std::vector<Match> matches{at(4, route), at(7, route)};
  place::name_places(matches, route);
  EXPECT_EQ(matches[0].nearest_place, "bench, \"old\"");
  EXPECT_EQ(matches[1].nearest_place, "door");
  EXPECT_FALSE(matches[1].nearest_place_m);
}

TEST(NearestPlace, GoesByKeyframesWhereAPlaceIsNotSurveyed) {
  place::Route route = twenty_metres();
  for (const std::size_t k : {7U, 8U, 9U})
    route.traverses[0].keyframes[k].distance_m.reset();  // about the door
  std::vector<Match> matches{at(5, route), at(6, route)};
  place::name_places(matches, route);
  EXPECT_EQ(matches[0].nearest_place, "bench, \"old\"");  // two and a half keyframes, the door three
  EXPECT_DOUBLE_EQ(*matches[0].nearest_place_m, -5);
  EXPECT_EQ(matches[1].nearest_place, "door");  // two keyframes, fewer than the bench's 7 m
  EXPECT_FALSE(matches[1].nearest_place_m);
}

TEST(NearestPlace, LeavesMatchesOfARouteWithoutNamesAlone) {
  place::Route route = twenty_metres();
  route.traverses[0].places.clear();
  std::vector<Match> matches{at(4, route)};
  place::name_places(matches, route);
  EXPECT_TRUE(matches[0].nearest_place.empty());
  place::name_places({}, route);
}

TEST(NearestPlace, RefusesMatchesOfAnotherRoute) {
  const place::Route route = twenty_metres();
  std::vector<Match> elsewhere{at(4, route, "night")}, beyond{at(11, route)};
  EXPECT_THROW(place::name_places(elsewhere, route), std::invalid_argument);
  EXPECT_THROW(place::name_places(beyond, route), std::invalid_argument);
}

TEST(NearestPlace, IsInTheFileOfMatchesWithItsCommasAndQuotes) {
  const place::Route route = twenty_metres();
  std::vector<Match> matches{at(4, route)};
  place::name_places(matches, route);
  const std::string text = place::to_csv(matches);
  EXPECT_NE(text.find(",nearest_place,nearest_place_m\n"), std::string::npos);
  EXPECT_NE(text.find(",\"bench, \"\"old\"\"\",-3\n"), std::string::npos) << text;
}

}  // namespace
