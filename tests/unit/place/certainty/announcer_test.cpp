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

}  // namespace
