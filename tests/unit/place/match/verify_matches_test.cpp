#include "support/point_scene.hpp"
#include "support/rendered_room.hpp"
#include "support/seen_points.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <place/match/verify_matches.hpp>
#include <vo/base/parallel.hpp>

namespace {

using place::Match;
using place::Route;
using test_support::marked_points;
using test_support::packed_view;
using test_support::point_scene;
using test_support::turned;

constexpr double kSpacing_m = 0.85, kHeading_rad = 1.9, kNoise = 5e-4;
constexpr std::size_t kKeyframes = 7, kMatched = 3;

/// Seven keyframes straight ahead through one scene, the fourth at (10, 20), all heading `kHeading_rad`.
Route straight_route() {
  Route route;
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.name = "there";
  const auto marked = marked_points(point_scene(200), 1);
  for (std::size_t k = 0; k < kKeyframes; ++k) {
    const double ahead_m = kSpacing_m * (static_cast<double>(k) - kMatched);
    place::Keyframe& keyframe = traverse.keyframes.emplace_back();
    keyframe.pose =
        vo::Pose2{10 + ahead_m * std::sin(kHeading_rad), 20 + ahead_m * std::cos(kHeading_rad), kHeading_rad};
    traverse.view_points.push_back(packed_view(turned(0, {0, 0, ahead_m}), marked, kNoise, k + 2));
  }
  return route;
}

/// Matches with the fourth keyframe, all alike.
std::vector<Match> matches_of(const Route& route, std::size_t count = 1) {
  Match match;
  match.place = place::Place{.traverse = "there", .keyframe = kMatched};
  match.place->pose = route.traverses[0].keyframes[kMatched].pose;
  return std::vector<Match>(count, match);
}

/// Seen from aside, ahead and turned; `place` of another seed is another place.
place::Bytes query(double right_m, double ahead_m, double turn_rad, std::uint64_t place = 1) {
  return packed_view(turned(turn_rad, {right_m, 0, ahead_m}), marked_points(point_scene(200), place), kNoise,
                     99);
}

TEST(VerifyMatches, SayTurnAndPlaceBesideTheRoute) {
  const Route route = straight_route();
  for (const auto& [right_m, ahead_m, turn_rad] :
       {std::array{0.5, 0.0, 0.0}, std::array{-1.0, 0.3, 0.17}, std::array{1.0, -0.4, -0.17}}) {
    const std::vector<place::Bytes> points{query(right_m, ahead_m, turn_rad)};
    auto matches = matches_of(route);
    place::verify_matches(route, points, {}, matches);
    ASSERT_TRUE(matches[0].yaw_rad && matches[0].lateral_m && matches[0].ahead_m) << right_m;
    // Directions of two degrees from within 2.5 m, seven together.
    EXPECT_NEAR(*matches[0].yaw_rad, turn_rad, 0.005) << right_m;
    EXPECT_NEAR(*matches[0].lateral_m, right_m, 0.06) << right_m;
    EXPECT_NEAR(*matches[0].ahead_m, ahead_m, 0.15) << right_m;
  }
}

TEST(VerifyMatches, OfOnePlaceOrWithoutPosesSayTheTurnOnly) {
  Route route = straight_route();
  const std::vector<place::Bytes> points{query(0.5, 0, 0.1)};
  auto matches = matches_of(route);
  place::verify_matches(route, points, {.places = 1}, matches);
  EXPECT_NEAR(matches[0].yaw_rad.value(), 0.1, 0.005);
  EXPECT_FALSE(matches[0].lateral_m || matches[0].ahead_m);

  for (auto& keyframe : route.traverses[0].keyframes) keyframe.pose.reset();
  matches = matches_of(route);
  place::verify_matches(route, points, {}, matches);
  EXPECT_NEAR(matches[0].yaw_rad.value(), 0.1, 0.005);
  EXPECT_FALSE(matches[0].lateral_m || matches[0].ahead_m);
}

TEST(VerifyMatches, SayNothingOfAWrongPlace) {
  const Route route = straight_route();
  for (std::uint64_t other = 2; other < 8; ++other) {
    const std::vector<place::Bytes> points{query(0.5, 0, 0.1, other)};
    auto matches = matches_of(route);
    place::verify_matches(route, points, {}, matches);
    EXPECT_FALSE(matches[0].lateral_m || matches[0].ahead_m) << other;
  }
}

TEST(VerifyMatches, LeaveAllElseAsItIs) {
  Route route = straight_route();
  std::vector<Match> matches(3);
  matches[1] = matches_of(route)[0];
  matches[1].score = 2;
  matches[1].accepted = true;
  const std::vector<place::Bytes> points{query(0, 0, 0), {}, query(0, 0, 0)};  // the matched one is black
  place::verify_matches(route, points, {}, matches);
  for (const Match& match : matches) EXPECT_FALSE(match.yaw_rad || match.lateral_m || match.ahead_m);
  EXPECT_EQ(matches[1].score, 2);
  EXPECT_TRUE(matches[1].accepted);

  route.traverses[0].view_points.clear();  // a traverse of before
  matches = matches_of(route);
  place::verify_matches(route, std::vector<place::Bytes>{query(0, 0, 0)}, {}, matches);
  EXPECT_FALSE(matches[0].yaw_rad);

  matches.clear();
  place::verify_matches(route, {}, {}, matches);
  EXPECT_THROW(place::verify_matches(route, points, {}, matches), std::invalid_argument);
  EXPECT_THROW(place::verify_matches(route, {}, {.places = 0}, matches), std::invalid_argument);
}

TEST(VerifyMatches, AreTheSameForAnyNumberOfThreads) {
  const Route route = straight_route();
  std::vector<place::Bytes> points;
  for (int i = 0; i < 12; ++i) points.push_back(query(0.1 * i - 0.6, 0.05 * i, 0.02 * i));
  vo::set_thread_count(1);
  auto one = matches_of(route, points.size());
  place::verify_matches(route, points, {}, one);
  vo::set_thread_count(4);
  auto four = matches_of(route, points.size());
  place::verify_matches(route, points, {}, four);
  vo::set_thread_count(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(one[i].yaw_rad, four[i].yaw_rad);
    EXPECT_EQ(one[i].lateral_m, four[i].lateral_m);
    EXPECT_EQ(one[i].ahead_m, four[i].ahead_m);
  }
}

}  // namespace
