#include "place/match/reference_timeline.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace place {
namespace {

using ::testing::DoubleNear;
using ::testing::Optional;

constexpr double kExact = 1e-9;  // sums of a few terms below a thousand

/// Keyframes 0.5 m apart, walked at two speeds: at frames 0, 10, ... 50, then 52, 54, ... 60.
Route made_route(std::string name = "day") {
  Traverse traverse;
  traverse.name = std::move(name);
  for (int k = 0; k <= 10; ++k) {
    Keyframe keyframe;
    keyframe.frame = k <= 5 ? 10 * k : 50 + 2 * (k - 5);
    keyframe.displacement = 0.5 * k;
    traverse.keyframes.push_back(keyframe);
  }
  traverse.frames = 61;
  Route route;
  route.metric = true;
  route.unit = 0.5;
  route.traverses.push_back(std::move(traverse));
  return route;
}

Match found(std::int64_t query_frame, std::size_t keyframe, bool accepted = true,
            const std::string& traverse = "day") {
  Match match;
  match.query_frame = query_frame;
  match.place = Place{.traverse = traverse, .keyframe = keyframe, .frame = 0, .distance_m = {}, .pose = {}};
  match.accepted = accepted;
  return match;
}

TEST(ReferenceTimeline, GoesAlongTheRouteAsFarAsTheQueryHasCome) {
  const Route route = made_route();
  const std::vector<Match> matches{found(0, 4), found(4, 5), found(8, 7)};
  const auto timeline = reference_timeline(route, matches, 9);
  ASSERT_EQ(timeline.size(), 9U);
  // Frames 0 to 4 go from keyframe 4 (frame 40) to 5 (frame 50), frames 4 to 8 on to keyframe 7 (frame 54).
  const double frames[] = {40, 42.5, 45, 47.5, 50, 51, 52, 53, 54};
  const double metres[] = {2, 2.125, 2.25, 2.375, 2.5, 2.75, 3, 3.25, 3.5};
  for (std::size_t i = 0; i < 9; ++i) {
    ASSERT_TRUE(timeline[i].reference) << i;
    EXPECT_NEAR(timeline[i].reference->frame, frames[i], kExact) << i;
    EXPECT_THAT(timeline[i].reference->distance_m, Optional(DoubleNear(metres[i], kExact))) << i;
  }
  EXPECT_EQ(timeline[1].match, 0U);
  EXPECT_EQ(timeline[2].match, 1U);  // as near to either: the later one
  EXPECT_EQ(timeline[7].match, 2U);
}

TEST(ReferenceTimeline, StandsWhereTheQueryStands) {
  const Route route = made_route();
  const std::vector<Match> matches{found(0, 2), found(4, 3)};
  const std::vector<double> travelled{0, 0.1, 0.1, 0.1, 0.4};
  const auto timeline = reference_timeline(route, matches, 5, travelled);
  const double frames[] = {20, 22.5, 22.5, 22.5, 30};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(timeline[i].reference->frame, frames[i], kExact) << i;
}

TEST(ReferenceTimeline, AtKeyframesItIsWhatWasMatchedAndNeverGoesBackBetweenThem) {
  const Route route = made_route();
  std::vector<Match> matches;
  for (std::size_t k = 0; k <= 10; ++k) matches.push_back(found(static_cast<std::int64_t>(7 * k + 3), k));
  const auto timeline = reference_timeline(route, matches, 80);
  for (const Match& match : matches) {
    const auto& moment = timeline[static_cast<std::size_t>(match.query_frame)];
    EXPECT_NEAR(moment.reference->frame,
                static_cast<double>(route.traverses[0].keyframes[match.place->keyframe].frame), kExact);
  }
  for (std::size_t i = 1; i < timeline.size(); ++i)
    EXPECT_GE(timeline[i].reference->frame, timeline[i - 1].reference->frame) << i;
  EXPECT_NEAR(timeline[0].reference->frame, 0, kExact);    // before the first keyframe: its place
  EXPECT_NEAR(timeline[79].reference->frame, 60, kExact);  // after the last
}

TEST(ReferenceTimeline, ShowsNothingAboutARefusedMatch) {
  const Route route = made_route();
  std::vector<Match> matches{found(0, 1), found(10, 2, false), found(20, 3)};
  matches[1].place.reset();
  const auto timeline = reference_timeline(route, matches, 21);
  for (std::size_t i = 0; i <= 20; ++i) {
    const bool off_route = i >= 5 && i < 15;
    EXPECT_EQ(timeline[i].reference.has_value(), !off_route) << i;
    if (!off_route) {
      EXPECT_NEAR(timeline[i].reference->frame, i < 5 ? 10 : 30, kExact) << i;
    }
  }
}

TEST(ReferenceTimeline, DoesNotInterpolateAcrossGapsJumpsAndTraverses) {
  Route route = made_route();
  route.traverses.push_back(made_route("night").traverses[0]);
  const auto in_the_middle = [&](const Match& a, const Match& b, std::vector<std::size_t> gaps = {}) {
    const std::vector<Match> matches{a, b};
    const auto timeline = reference_timeline(route, matches, 9, {}, gaps);
    return std::pair(timeline[3].reference->keyframe, timeline[5].reference->keyframe);
  };
  const auto only = [](double a, double b) { return std::pair(a, b); };
  EXPECT_EQ(in_the_middle(found(0, 2), found(8, 7)), only(2 + 5 * 3. / 8, 2 + 5 * 5. / 8));  // five ahead
  EXPECT_EQ(in_the_middle(found(0, 2), found(8, 8)), only(2, 8));                            // six
  EXPECT_EQ(in_the_middle(found(0, 4), found(8, 3)), only(4, 3));                            // back
  EXPECT_EQ(in_the_middle(found(0, 4), found(8, 5), {1}), only(4, 5));                       // query's gap
  EXPECT_EQ(in_the_middle(found(0, 4), found(8, 5, true, "night")), only(4, 5));
  route.traverses[0].keyframes[5].after_gap = true;
  EXPECT_EQ(in_the_middle(found(0, 4), found(8, 6)), only(4, 6));  // the reference's gap
  EXPECT_EQ(in_the_middle(found(0, 5), found(8, 6)), only(5 + 3. / 8, 5 + 5. / 8));
  EXPECT_EQ(reference_timeline(route, std::vector{found(0, 1, true, "night")}, 1)[0].reference->traverse, 1U);
}

TEST(ReferenceTimeline, SurveyedDistancesAndTurns) {
  Route route = made_route();
  for (std::size_t k = 0; k <= 10; ++k)
    route.traverses[0].keyframes[k].distance_m = 100 + static_cast<double>(k);
  std::vector<Match> matches{found(0, 1), found(4, 2), found(8, 3)};
  matches[0].yaw_rad = 0.2;
  matches[1].yaw_rad = 0.4;
  auto timeline = reference_timeline(route, matches, 9);
  EXPECT_THAT(timeline[1].reference->distance_m, Optional(DoubleNear(101.25, kExact)));
  EXPECT_THAT(timeline[1].reference->yaw_rad, Optional(DoubleNear(0.25, kExact)));
  EXPECT_THAT(timeline[5].reference->yaw_rad, Optional(DoubleNear(0.4, kExact)));  // the nearer one's
  EXPECT_FALSE(timeline[7].reference->yaw_rad);

  route.metric = false;
  for (Keyframe& keyframe : route.traverses[0].keyframes) keyframe.distance_m.reset();
  timeline = reference_timeline(route, matches, 9);
  EXPECT_FALSE(timeline[1].reference->distance_m);
}

TEST(ReferenceTimeline, EmptyAndRefusedInput) {
  const Route route = made_route();
  EXPECT_TRUE(reference_timeline(route, {}, 5).empty());
  const std::vector<Match> one{found(2, 3)};
  const auto timeline = reference_timeline(route, one, 5);
  ASSERT_EQ(timeline.size(), 5U);
  for (const QueryMoment& moment : timeline) EXPECT_NEAR(moment.reference->frame, 30, kExact);

  const auto refused = [&](const std::vector<Match>& matches, std::vector<double> travelled = {}) {
    EXPECT_THROW(reference_timeline(route, matches, 5, travelled), std::invalid_argument);
  };
  refused({found(3, 1), found(3, 2)});
  refused({found(5, 1)});
  refused({found(1, 11)});
  refused({found(1, 1, true, "night")});
  refused(one, {0, 1});
  Match nowhere = found(1, 1);
  nowhere.place.reset();
  refused({nowhere});
}

}  // namespace
}  // namespace place
