#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/certainty/announcer.hpp>

namespace {

using place::FollowEventKind;
using place::FollowState;

/// Twenty metres north, then twenty east, a keyframe a metre.
place::Route around_a_corner() {
  place::Traverse traverse;
  traverse.name = "day";
  for (int k = 0; k <= 40; ++k) {
    place::Keyframe keyframe;
    keyframe.frame = 10 * k;
    keyframe.pose =
        vo::Pose2{k > 20 ? k - 20.0 : 0.0, k > 20 ? 20.0 : k * 1.0, k > 20 ? std::numbers::pi / 2 : 0};
    traverse.keyframes.push_back(keyframe);
  }
  place::Route route;
  route.traverses.push_back(traverse);
  return route;
}

place::Position at(std::size_t keyframe, FollowState state = FollowState::kOnRoute) {
  place::Position position{.frame = static_cast<std::int64_t>(keyframe), .state = state};
  if (state == FollowState::kOnRoute)
    position.place = place::FollowedPlace{.traverse = "day", .keyframe = keyframe};
  return position;
}

std::vector<std::string> names(const std::vector<place::FollowEvent>& events) {
  std::vector<std::string> all;
  for (const auto& event : events) all.push_back(place::name_of(event.kind));
  return all;
}

TEST(TurnsOf, FindsTheCorner) {
  const auto turns = place::turns_of(around_a_corner().traverses[0]);
  ASSERT_EQ(turns.size(), 1U);
  EXPECT_NEAR(turns[0].at_m, 20, 2);  // anywhere within the reach of 2 m the difference is the same
  EXPECT_NEAR(turns[0].turn_deg, 90, 1e-9);
  place::Traverse bare;
  bare.keyframes.resize(5);
  EXPECT_TRUE(place::turns_of(bare).empty());
}

TEST(Announcer, TellsAWalkerWhatHeNeeds) {
  const place::Route route = around_a_corner();
  place::Announcer announcer(route);
  EXPECT_THAT(announcer.push(at(0, FollowState::kSearching)), testing::IsEmpty());
  EXPECT_THAT(names(announcer.push(at(3))), testing::ElementsAre("found"));
  std::vector<place::FollowEvent> events;
  for (std::size_t k = 4; k <= 40; ++k)
    for (const auto& event : announcer.push(at(k))) events.push_back(event);
  ASSERT_THAT(names(events), testing::ElementsAre("turn_ahead", "end_of_route"));
  EXPECT_NEAR(*events[0].turn_deg, 90, 1e-9);
  EXPECT_LE(*events[0].distance_m, 8);
  EXPECT_GT(*events[0].distance_m, 6);
  EXPECT_EQ(events[1].distance_m, 3);
}

TEST(Announcer, SaysThatTheRouteIsLeftAndFoundAgain) {
  const place::Route route = around_a_corner();
  place::Announcer announcer(route);
  announcer.push(at(3));
  EXPECT_THAT(names(announcer.push(at(3, FollowState::kOffRoute))), testing::ElementsAre("left_route"));
  EXPECT_THAT(announcer.push(at(3, FollowState::kOffRoute)), testing::IsEmpty());
  EXPECT_THAT(names(announcer.push(at(5))), testing::ElementsAre("back_on_route"));
  announcer.push(at(5, FollowState::kSearching));
  EXPECT_THAT(names(announcer.push(at(6))), testing::ElementsAre("found"));
}

TEST(Announcer, SaysNothingOfTurnsWithoutPoses) {
  place::Route route = around_a_corner();
  for (auto& keyframe : route.traverses[0].keyframes) keyframe.pose.reset();
  place::Announcer announcer(route);
  EXPECT_THAT(names(announcer.push(at(15))), testing::ElementsAre("found"));
  EXPECT_THAT(announcer.push(at(40)), testing::IsEmpty());
}

/// The events of one kind while the walker comes along these keyframes.
std::vector<place::FollowEvent> passed(place::Announcer& announcer,
                                       const std::vector<std::size_t>& keyframes) {
  std::vector<place::FollowEvent> all;
  for (const std::size_t k : keyframes)
    for (const auto& event : announcer.push(at(k)))
      if (event.kind == FollowEventKind::kPassing) all.push_back(event);
  return all;
}

TEST(Announcer, NamesEachPlaceOnceInPassing) {
  place::Route route = around_a_corner();
  route.traverses[0].places = {{"bakery", 65, {}}, {"bench", 300, {}}};
  place::Announcer announcer(route);
  std::vector<std::size_t> along(39);
  for (std::size_t k = 0; k < along.size(); ++k) along[k] = k;
  auto events = passed(announcer, along);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].name, "bakery");
  EXPECT_EQ(events[0].frame, 5);  // 6.5 m along, first within 2 m at the fifth metre
  EXPECT_DOUBLE_EQ(*events[0].distance_m, 1.5);
  EXPECT_EQ(events[1].name, "bench");
  EXPECT_DOUBLE_EQ(*events[1].distance_m, 2);

  // To and fro near the bench is one passing; from 8 m away and back is the next.
  EXPECT_TRUE(passed(announcer, {30, 24, 31, 35, 30}).empty());
  events = passed(announcer, {21, 28});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].name, "bench");
}

TEST(Announcer, NamesAPlaceThatIsPassedBetweenTwoLinesButNoneJumpedOver) {
  place::Route route = around_a_corner();
  route.traverses[0].places = {{"bakery", 60, {}}};
  place::Announcer announcer(route);
  auto events = passed(announcer, {3, 10});  // 3 m before it, then 4 m after
  ASSERT_EQ(events.size(), 1U);
  EXPECT_DOUBLE_EQ(*events[0].distance_m, -4);
  place::Announcer other(route);
  EXPECT_TRUE(passed(other, {1, 30}).empty());  // carried there
}

TEST(Announcer, NamesAPlaceAgainAfterTheRouteWasLeft) {
  place::Route route = around_a_corner();
  route.traverses[0].places = {{"bakery", 60, {}}};
  place::Announcer announcer(route);
  EXPECT_EQ(passed(announcer, {6}).size(), 1U);
  announcer.push(at(6, FollowState::kSearching));
  EXPECT_TRUE(passed(announcer, {6}).empty());
  announcer.push(at(6, FollowState::kOffRoute));
  EXPECT_EQ(passed(announcer, {6}).size(), 1U);
}

TEST(Announcer, NamesPlacesOfBothWalksOnce) {
  place::Route route = around_a_corner();
  route.traverses.push_back(route.traverses[0]);
  route.traverses[1].name = "night";
  route.traverses[0].places = {{"bakery", 60, {}}};
  route.traverses[1].places = {{"bakery", 70, {}}};
  place::Announcer announcer(route);
  EXPECT_EQ(passed(announcer, {5}).size(), 1U);
  place::Position other = at(6);
  other.place->traverse = "night";
  EXPECT_TRUE(announcer.push(other).empty());
}

TEST(Announcer, NamesPlacesWithoutMetres) {
  place::Route route = around_a_corner();
  for (auto& keyframe : route.traverses[0].keyframes) keyframe.pose.reset();
  route.traverses[0].places = {{"bakery", 60, {}}};
  place::Announcer announcer(route);
  const auto events = passed(announcer, {3, 4, 5, 6, 7});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].frame, 5);  // a keyframe before
  EXPECT_FALSE(events[0].distance_m);
}

TEST(Announcer, SaysTheEndBySurveyedDistances) {
  place::Route route = around_a_corner();
  for (std::size_t k = 0; k < 41; ++k) {
    route.traverses[0].keyframes[k].pose.reset();
    route.traverses[0].keyframes[k].distance_m = 100 + static_cast<double>(k);
  }
  place::Announcer announcer(route);
  EXPECT_THAT(names(announcer.push(at(36))), testing::ElementsAre("found"));
  const auto events = announcer.push(at(38));
  ASSERT_THAT(names(events), testing::ElementsAre("end_of_route"));
  EXPECT_DOUBLE_EQ(*events[0].distance_m, 2);
}

TEST(Announcer, AnnouncesAgainOnTheNextRound) {
  place::Announcer announcer(around_a_corner());
  for (std::size_t k = 3; k <= 40; ++k) announcer.push(at(k));
  std::vector<place::FollowEvent> events;
  for (std::size_t k = 0; k <= 40; ++k)
    for (const place::FollowEvent& event : announcer.push(at(k))) events.push_back(event);
  EXPECT_THAT(names(events), testing::ElementsAre("turn_ahead", "end_of_route"));
}

TEST(Announcer, AnnouncesTheTurnsOfATraverseThatBeginsElsewhere) {
  place::Route route = around_a_corner();
  route.traverses.push_back(route.traverses[0]);
  route.traverses[1].name = "night";
  place::Announcer announcer(route);
  announcer.push(at(14));  // announces the corner at 20 m
  const auto on_night = [&](std::size_t k) {
    place::Position position = at(k);
    position.place->traverse = "night";
    return announcer.push(position);
  };
  on_night(5);  // its corner is another one, 15 m ahead
  EXPECT_THAT(names(on_night(16)), testing::ElementsAre("turn_ahead"));
}

}  // namespace
