#include "follow_matches.hpp"

#include <optional>

#include <gtest/gtest.h>

namespace {

using namespace retrace;

/// Ten keyframes, a metre and half a second apart.
place::Route ten_metres() {
  place::Route route;
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.name = "day";
  for (int k = 0; k < 10; ++k)
    traverse.keyframes.push_back({.frame = 15 * k, .time_s = 0.5 * k, .distance_m = 1.0 * k});
  return route;
}

place::FollowedPlace at(std::size_t keyframe, double probability) {
  return {.traverse = "day",
          .keyframe = keyframe,
          .reference_frame = static_cast<std::int64_t>(15 * keyframe),
          .distance_m = static_cast<double>(keyframe),
          .sd_m = 0.5,
          .sd_keyframes = 0.5,
          .probability = probability,
          .pose = {}};
}

place::Position position(std::int64_t frame, bool described, std::optional<place::FollowedPlace> place) {
  return {.frame = frame,
          .time_s = static_cast<double>(frame) / 30,
          .state = place ? place::FollowState::kOnRoute : place::FollowState::kSearching,
          .place = std::move(place),
          .described = described};
}

TEST(FollowMatches, AreOneForEachPictureThatWasCompared) {
  const place::Route route = ten_metres();
  FollowMatches followed(route);
  EXPECT_TRUE(followed.matches().empty());
  followed.push(position(0, true, {}));
  followed.push(position(1, false, {}));
  followed.push(position(2, true, at(3, 0.75)));
  ASSERT_EQ(followed.matches().size(), 2U);
  const place::Match &lost = followed.matches()[0], &found = followed.matches()[1];
  EXPECT_EQ(lost.query_frame, 0);
  EXPECT_FALSE(lost.place);
  EXPECT_FALSE(lost.accepted);
  EXPECT_EQ(lost.score, 0);
  EXPECT_EQ(found.query_frame, 2);
  EXPECT_EQ(found.place->frame, 45);
  EXPECT_EQ(found.place->time_s, 1.5);
  EXPECT_EQ(found.place->distance_m, 3.0);
  EXPECT_EQ(found.score, 0.75);
  EXPECT_EQ(found.probability, 0.75);
  EXPECT_TRUE(found.accepted);
}

TEST(FollowMatches, TakeTheSurerAnswerWhenItComes) {
  const place::Route route = ten_metres();
  FollowMatches followed(route);
  followed.push(position(0, true, {}));
  followed.push(position(10, true, at(8, 0.6)));
  place::Position later = position(20, true, at(4, 0.9));
  later.lag_frame = 10;
  later.lag_place = at(3, 0.95);
  followed.push(later);
  EXPECT_EQ(followed.matches()[1].place->keyframe, 3U);
  EXPECT_EQ(followed.matches()[1].query_time_s, 10.0 / 30);
  // What is known at the end: also that he was on no place, and nothing of a frame that was not compared.
  followed.finish(
      {{.frame = 0, .place = at(2, 0.8)}, {.frame = 5, .place = at(2, 0.8)}, {.frame = 20, .place = {}}});
  ASSERT_EQ(followed.matches().size(), 3U);
  EXPECT_EQ(followed.matches()[0].place->keyframe, 2U);
  EXPECT_TRUE(followed.matches()[0].accepted);
  EXPECT_FALSE(followed.matches()[2].place);
  EXPECT_FALSE(followed.matches()[2].accepted);
  EXPECT_EQ(followed.matches()[2].query_frame, 20);
}

}  // namespace
