#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/trajectory/pose_fixes.hpp>

namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A match of keyframe q to a traverse; with a pose `x_m` east, unless that is missing.
place::Match match_on(const std::string& traverse, std::optional<double> x_m, bool accepted = true) {
  place::Match match{.score = 2, .accepted = accepted};
  match.place = place::Place{.traverse = traverse};
  if (x_m) match.place->pose = vo::Pose2{*x_m, 0, 0};
  return match;
}

TEST(PoseFixes, AreSurveyedIfAnyIs) {
  place::Route route;
  route.traverses.resize(4);
  const char* names[] = {"own odometry", "survey", "second survey", "own again"};
  for (std::size_t i = 0; i < 4; ++i) {
    route.traverses[i].name = names[i];
    route.traverses[i].surveyed = i == 1 || i == 2;
  }
  std::vector<place::Match> matches{match_on("own odometry", 1),         match_on("survey", 2),
                                    match_on("own odometry", 3),         match_on("own odometry", 4),
                                    match_on("second survey", 5),        match_on("second survey", 6),
                                    match_on("second survey", 7, false), match_on("survey", {})};
  matches.emplace_back();  // nothing matched
  const auto surveyed = place::pose_fixes(route, matches);
  ASSERT_THAT(surveyed.fixes, SizeIs(3));
  EXPECT_EQ(surveyed.fixes[0].node, 1U);
  EXPECT_EQ(surveyed.fixes[0].pose.x_m, 2);
  EXPECT_EQ(surveyed.fixes[0].score, 2);
  EXPECT_EQ(surveyed.fixes[2].node, 5U);
  EXPECT_EQ(surveyed.traverse, 2U);  // with two of the three

  matches[1].probability = 0.97;
  matches[1].sd_m = 0.4;
  const auto sure = place::pose_fixes(route, matches);
  EXPECT_EQ(sure.fixes[0].probability, 0.97);
  EXPECT_EQ(sure.fixes[0].sd_m, 0.4);
  EXPECT_EQ(sure.fixes[1].probability, std::nullopt);

  // Seen beside and ahead of where the reference walked, which heads north.
  EXPECT_EQ(sure.fixes[1].aside_sd_m, std::nullopt);
  for (const std::size_t i : {1, 4, 5}) matches[i].lateral_m = -0.5;
  matches[4].ahead_m = 0.25;
  matches.push_back(match_on("survey", 9));
  const auto seen = place::pose_fixes(route, matches);
  ASSERT_THAT(seen.fixes, SizeIs(4));
  EXPECT_EQ(seen.fixes[0].pose.x_m, 1.5);
  EXPECT_EQ(seen.fixes[0].pose.y_m, 0);
  EXPECT_EQ(seen.fixes[1].pose.y_m, 0.25);
  EXPECT_LT(seen.fixes[0].aside_sd_m.value(), place::DriftCorrectionOptions{}.aside_m);
  EXPECT_EQ(seen.fixes[3].pose.x_m, 9);
  EXPECT_GT(seen.fixes[3].aside_sd_m.value(), place::DriftCorrectionOptions{}.aside_m);  // it was not seen

  // Two walks' odometry have nothing in common: the one with more.
  const auto own = place::pose_fixes(
      route, {match_on("own again", 1), match_on("own odometry", 2), match_on("own odometry", 3)});
  ASSERT_THAT(own.fixes, SizeIs(2));
  EXPECT_EQ(own.fixes[0].node, 1U);
  EXPECT_EQ(own.traverse, 0U);

  EXPECT_THAT(place::pose_fixes(route, {}).fixes, IsEmpty());
  EXPECT_FALSE(place::pose_fixes(route, {match_on("survey", {})}).traverse);
}

}  // namespace
