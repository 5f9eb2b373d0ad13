#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/gait/dead_reckoning.hpp>

namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;
constexpr vo::DeadReckoningOptions kPaper{.as_published = true};

/// Frames at 8 Hz, whose times have no rounding in them.
std::vector<double> times(std::size_t frames) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / 8;
  return time_s;
}

std::vector<vo::Step> steps_at(const std::vector<std::size_t>& frames) {
  std::vector<vo::Step> steps;
  for (const std::size_t frame : frames)
    steps.push_back({.frame = frame,
                     .time_s = static_cast<double>(frame) / 8,
                     .leg = vo::Leg::kLeft,
                     .value = 0,
                     .bridged = false});
  return steps;
}

TEST(StepDisplacement, IsSpreadEvenlyOverEachStep) {
  // The first step takes as long as the second: 4 frames, from frame 2 on.
  EXPECT_THAT(vo::step_displacement_m(steps_at({6, 10, 12}), std::vector<double>{1, 2, 1}, times(14)),
              ElementsAre(0, 0, 0, 0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0));
}

TEST(StepDisplacement, IsZeroInAPause) {
  // 40 frames are 5 s; the step after them takes as long as its follower.
  const auto metres =
      vo::step_displacement_m(steps_at({4, 8, 48, 50}), std::vector<double>{1, 1, 1, 1}, times(60));
  for (std::size_t i = 0; i < 60; ++i) {
    const double expected = i == 0 || (i > 8 && i <= 46) || i > 50 ? 0 : i <= 8 ? 0.25 : 0.5;
    EXPECT_EQ(metres[i], expected) << i;
  }
}

TEST(StepDisplacement, OfALoneStepTakesHalfASecond) {
  EXPECT_THAT(vo::step_displacement_m(steps_at({6}), std::vector<double>{1}, times(8)),
              ElementsAre(0, 0, 0, 0.25, 0.25, 0.25, 0.25, 0));
  // Cut off where the walk begins, it is still a whole step.
  EXPECT_THAT(vo::step_displacement_m(steps_at({2}), std::vector<double>{1}, times(4)),
              ElementsAre(0, 0.5, 0.5, 0));
}

TEST(StepDisplacement, CountsTheSharesOfStepsAtTheEnds) {
  // Steps take 4 frames: half of the first is made in frames 3 and 4, three quarters of one more after
  // frame 12.
  EXPECT_THAT(vo::step_displacement_m(steps_at({4, 8, 12}), std::vector<double>{1, 1, 2}, times(17),
                                      {.first = 0.5, .after = 0.75}),
              ElementsAre(0, 0, 0, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0));
  EXPECT_THAT(vo::step_displacement_m({}, {}, times(3), {.first = 0.5, .after = 0.5}), Each(0));
  EXPECT_THROW(vo::step_displacement_m({}, {}, times(3), {.first = 1.1, .after = 0}), std::invalid_argument);
  EXPECT_THROW(vo::step_displacement_m({}, {}, times(3), {.first = 1, .after = -0.1}), std::invalid_argument);
}

TEST(StepDisplacement, IsEvenWhereTheExtremaLimp) {
  // Left steps are seen 2 frames early of the 8 between steps: intervals of 6 and 10 frames by turns.
  std::vector<vo::Step> steps = steps_at({10, 16, 26, 32, 42, 48, 58});
  for (std::size_t i = 1; i < steps.size(); i += 2) steps[i].leg = vo::Leg::kRight;
  const auto metres = vo::step_displacement_m(steps, std::vector<double>(7, 0.8), times(64));
  // Evened out, there is a step at 11, 15 + ... every 8 frames: left ones a frame later, right ones earlier.
  for (std::size_t i = 12; i <= 57; ++i) EXPECT_NEAR(metres[i], 0.1, 1e-12) << i;  // rounding
  EXPECT_NEAR(std::accumulate(metres.begin(), metres.end(), 0.0), 7 * 0.8, 1e-12);
}

TEST(StepDisplacement, SumsUpToTheLengths) {
  vo::Rng rng(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<std::size_t> frames;
    std::vector<double> lengths, time_s{0};
    for (std::size_t frame = 1 + rng.index(20); frame < 500; frame += 1 + rng.index(30)) {
      frames.push_back(frame);
      lengths.push_back(rng.uniform(0.4, 1));
    }
    while (time_s.size() < 500) time_s.push_back(time_s.back() + rng.uniform(0.01, 0.1));
    auto steps = steps_at(frames);
    for (vo::Step& step : steps) {
      step.time_s = time_s[step.frame];
      step.leg = rng.index(2) == 0 ? vo::Leg::kLeft : vo::Leg::kRight;
    }
    const auto metres = vo::step_displacement_m(steps, lengths, time_s);
    EXPECT_THAT(metres, Each(testing::Ge(0)));
    EXPECT_NEAR(std::accumulate(metres.begin(), metres.end(), 0.0),
                std::accumulate(lengths.begin(), lengths.end(), 0.0), 1e-9);  // rounding
  }
}

TEST(DeadReckon, FollowsThePaperByHand) {
  // North, east, and south-west by one step each.
  std::vector<double> heading(13, 9.0);
  heading[4] = 0;
  heading[8] = kPi / 2;
  heading[12] = -3 * kPi / 4;
  const auto walk = vo::dead_reckon(steps_at({4, 8, 12}), std::vector<double>{1, 2, std::sqrt(2.0)}, heading,
                                    times(13), {}, kPaper);
  ASSERT_EQ(walk.at_step.size(), 3U);
  const std::vector<std::pair<double, double>> expected{{0, 1}, {2, 1}, {1, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(walk.at_step[i].x_m, expected[i].first, 1e-12);  // rounding
    EXPECT_NEAR(walk.at_step[i].y_m, expected[i].second, 1e-12);
    EXPECT_DOUBLE_EQ(walk.at_step[i].heading_rad, heading[4 * (i + 1)]);
  }
  EXPECT_NEAR(walk.at_frame[6].pose.x_m, 1, 1e-12);  // half-way through the second step
  EXPECT_NEAR(walk.at_frame[6].pose.y_m, 1, 1e-12);
}

TEST(DeadReckon, AsPublishedEveryStepIsWholeAtItsFrame) {
  // Left steps come early and right ones late, by which ours are moved; PVO's are not.
  auto steps = steps_at({4, 10, 12, 18, 20, 26});
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i].leg = i % 2 == 0 ? vo::Leg::kLeft : vo::Leg::kRight;
  const std::vector<double> lengths(steps.size(), 0.5), heading(30, 0.0);
  const auto paper = vo::dead_reckon(steps, lengths, heading, times(30), {}, kPaper);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_DOUBLE_EQ(paper.at_step[i].y_m, 0.5 * static_cast<double>(i + 1));
    EXPECT_EQ(paper.at_frame[steps[i].frame].pose.y_m, paper.at_step[i].y_m);
  }
  const auto ours = vo::dead_reckon(steps, lengths, heading, times(30));
  EXPECT_GT(std::abs(ours.at_step[1].y_m - 1), 0.1);
}

TEST(DeadReckon, StraightAheadBothWaysAreOne) {
  const std::vector<double> heading(40, 1.1);
  const auto steps = steps_at({5, 9, 14, 33, 38});
  const std::vector<double> lengths{0.7, 0.8, 0.7, 0.6, 0.7};
  const auto ours = vo::dead_reckon(steps, lengths, heading, times(40));
  const auto paper = vo::dead_reckon(steps, lengths, heading, times(40), {}, kPaper);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_NEAR(ours.at_step[i].x_m, paper.at_step[i].x_m, 1e-12);  // rounding
    EXPECT_NEAR(ours.at_step[i].y_m, paper.at_step[i].y_m, 1e-12);
    EXPECT_NEAR(ours.at_step[i].heading_rad, 1.1, 1e-12);
  }
}

TEST(DeadReckon, GoesWhereTheWalkerLooksWhileStepping) {
  // A quarter turn within one step, evenly: the mean direction is half-way, however the last frame looks, and
  // the way as the crow flies shorter by sin(x) / x of half the turn.
  std::vector<double> heading(9, 0.0);
  for (std::size_t i = 1; i < 9; ++i) heading[i] = kPi / 2 * (static_cast<double>(i) - 0.5) / 8;
  const auto walk = vo::dead_reckon(steps_at({8}), std::vector<double>{1}, heading, times(9));
  EXPECT_EQ(walk.at_frame[4].pose.y_m, 0);  // a lone step takes the last half second
  const auto& step = walk.at_step[0];
  EXPECT_NEAR(step.heading_rad, 3 * kPi / 8, 1e-12);  // frames 5 to 8: the second half of the turn
  // The mean of 4 unit vectors across an eighth of a turn: sin(4 d / 2) / (4 sin(d / 2)) with d = pi / 16.
  EXPECT_NEAR(std::hypot(step.x_m, step.y_m), std::sin(kPi / 8) / (4 * std::sin(kPi / 32)), 1e-12);
}

TEST(DeadReckon, FramesAndStepsMeet) {
  vo::Rng rng(6);
  std::vector<double> heading{0};
  while (heading.size() < 300) heading.push_back(heading.back() + 0.1 * rng.normal());
  std::vector<std::size_t> frames;
  for (std::size_t frame = 3; frame < 280; frame += 3 + rng.index(12)) frames.push_back(frame);
  const auto steps = steps_at(frames);
  for (const bool as_published : {false, true}) {
    const auto walk = vo::dead_reckon(steps, std::vector<double>(steps.size(), 0.7), heading, times(300), {},
                                      {.as_published = as_published, .pause_s = 1.5});
    ASSERT_EQ(walk.at_frame.size(), 300U);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_EQ(walk.at_frame[steps[i].frame].pose.x_m, walk.at_step[i].x_m);
      EXPECT_EQ(walk.at_frame[steps[i].frame].pose.y_m, walk.at_step[i].y_m);
    }
    EXPECT_EQ(walk.at_frame.back().pose.x_m, walk.at_step.back().x_m);
    for (const vo::TimedPose& pose : walk.at_frame) EXPECT_LE(std::abs(pose.pose.heading_rad), kPi);
  }
}

TEST(DeadReckon, OfNoStepsStaysWhereItIs) {
  const auto walk = vo::dead_reckon({}, {}, std::vector<double>(5, 1.0), times(5));
  EXPECT_THAT(walk.at_step, IsEmpty());
  ASSERT_EQ(walk.at_frame.size(), 5U);
  EXPECT_EQ(walk.at_frame[4].pose.x_m, 0);
  EXPECT_THAT(vo::dead_reckon({}, {}, {}, {}).at_frame, IsEmpty());
}

TEST(DeadReckon, WalksStepsOfAGapUpToTheFrameAfterIt) {
  // Nothing is seen from 0.8 s to 2.8 s, in which there were two steps between those at both ends.
  std::vector<double> time_s = times(10);
  for (std::size_t i = 5; i < 10; ++i) time_s[i] += 2;
  std::vector<vo::Step> steps{{.frame = 4, .time_s = time_s[4]},
                              {.frame = 5, .time_s = time_s[4] + 0.7, .bridged = true},
                              {.frame = 5, .time_s = time_s[4] + 1.4, .bridged = true},
                              {.frame = 5, .time_s = time_s[5]}};
  const std::vector<double> lengths_m{1, 2, 3, 4}, heading(10, std::numbers::pi / 2);
  const vo::DeadReckoning walk = vo::dead_reckon(steps, lengths_m, heading, time_s);
  ASSERT_EQ(walk.at_frame.size(), 10U);
  EXPECT_NEAR(walk.at_frame[4].pose.x_m, 1, 1e-9);
  EXPECT_NEAR(walk.at_frame[5].pose.x_m, 10, 1e-9);
  EXPECT_NEAR(walk.at_frame[9].pose.x_m, 10, 1e-9);
  ASSERT_EQ(walk.at_step.size(), 4U);
  for (const vo::Pose2& pose : walk.at_step) EXPECT_NEAR(pose.heading_rad, std::numbers::pi / 2, 1e-9);
}

TEST(DeadReckon, RefusesWhatDoesNotFit) {
  const std::vector<double> heading(10, 0.0), one{1};
  EXPECT_THROW(vo::dead_reckon(steps_at({3}), {}, heading, times(10)), std::invalid_argument);
  EXPECT_THROW(vo::dead_reckon(steps_at({3}), one, heading, times(9)), std::invalid_argument);
  EXPECT_THROW(vo::dead_reckon(steps_at({10}), one, heading, times(10)), std::invalid_argument);
  EXPECT_THROW(vo::dead_reckon(steps_at({0}), one, heading, times(10)), std::invalid_argument);
  EXPECT_THROW(vo::dead_reckon(steps_at({5, 4}), std::vector<double>{1, 1}, heading, times(10)),
               std::invalid_argument);
}

TEST(DeadReckonDisplacement, GoesWhereItLooksByHand) {
  const auto walk =
      vo::dead_reckon(std::vector<double>{0, 2, 3, 1}, std::vector<double>{0, 0, kPi / 2, 3 * kPi}, times(4));
  ASSERT_EQ(walk.size(), 4U);
  EXPECT_EQ(walk[0].pose.x_m, 0);
  EXPECT_NEAR(walk[1].pose.y_m, 2, 1e-12);  // rounding
  EXPECT_NEAR(walk[2].pose.x_m, 3, 1e-12);
  EXPECT_NEAR(walk[3].pose.y_m, 1, 1e-12);
  EXPECT_NEAR(std::abs(walk[3].pose.heading_rad), kPi, 1e-12);
  EXPECT_EQ(walk[3].time_s, 0.375);
  EXPECT_THAT(vo::dead_reckon(std::vector<double>{}, std::vector<double>{}, std::vector<double>{}),
              IsEmpty());
  EXPECT_THROW(vo::dead_reckon(std::vector<double>{0}, std::vector<double>{}, std::vector<double>{0}),
               std::invalid_argument);
}

}  // namespace
