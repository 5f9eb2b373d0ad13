#include <cmath>
#include <cstddef>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/step_way.hpp>

namespace {

using testing::ElementsAre;

/// Ten frames a second, a step every 5 frames while one walks.
std::vector<double> seconds(std::size_t frames) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / 10;
  return time_s;
}

vo::StepDetection steps_at(const std::vector<std::size_t>& frames, const std::vector<double>& time_s) {
  vo::StepDetection detection;
  for (const std::size_t frame : frames)
    detection.steps.push_back({frame, time_s[frame], vo::Leg::kLeft, -1, false});
  return detection;
}

std::vector<std::size_t> completed(const std::vector<std::size_t>& frames,
                                   const std::vector<double>& growth) {
  const auto time_s = seconds(growth.size());
  const vo::StepWay way(growth, time_s, frames);
  std::vector<std::size_t> found;
  for (const vo::Step& step : vo::complete_steps(steps_at(frames, time_s), way, growth, time_s).steps)
    found.push_back(step.frame);
  return found;
}

TEST(StepWay, WorkedExample) {
  std::vector<double> growth(41, 0.02);
  for (std::size_t i = 21; i < 31; ++i) growth[i] = 0.005;  // a quarter as fast: half the cadence
  for (std::size_t i = 31; i < 41; ++i) growth[i] = 0.001;  // below 15 %: stands
  const auto time_s = seconds(41);
  const std::vector<std::size_t> frames{5, 10, 15, 20};
  const vo::StepWay way(growth, time_s, frames);
  ASSERT_TRUE(way.known());
  EXPECT_NEAR(way.step_s(10), 0.5, 1e-12);
  EXPECT_NEAR(way.between(5, 20, 10), 3, 1e-9);
  EXPECT_NEAR(way.between(20, 30, 20), 10 * 0.5 / 5, 1e-9);
  EXPECT_EQ(way.between(30, 40, 20), 0);
  EXPECT_TRUE(way.walking(10));
  EXPECT_FALSE(way.walking(36));
  EXPECT_FALSE(way.gap(10, 15));
  EXPECT_TRUE(way.gap(10, 18));  // 0.8 s are more than one and a half steps of 0.5 s
}

TEST(StepWay, OfOneStepIsNotKnown) {
  const std::vector<double> growth(10, 0.01);
  const auto time_s = seconds(10);
  EXPECT_FALSE(vo::StepWay(growth, time_s, std::vector<std::size_t>{5}).known());
  EXPECT_FALSE(vo::StepWay(growth, time_s, std::vector<std::size_t>{}).known());
}

TEST(CompleteSteps, FillsWhatWasLost) {
  const std::vector<double> growth(51, 0.02);
  // Of ten whole steps, that at frame 25 is lost.
  EXPECT_THAT(completed({5, 10, 15, 20, 30, 35, 40, 45}, growth),
              ElementsAre(5, 10, 15, 20, 25, 30, 35, 40, 45, 50));
  // Cut at frame 2: 9.6 steps, of which 9 are whole.
  EXPECT_THAT(completed({3, 8, 13, 18, 23, 28, 33, 38, 43, 48}, growth), testing::SizeIs(10));
  EXPECT_THAT(completed({4, 9, 14, 19, 24, 29, 34, 39, 44}, std::vector<double>(49, 0.02)),
              testing::SizeIs(9));
}

TEST(CompleteSteps, KeepsTheLargerOfTwoWithNoWayBetweenThem) {
  std::vector<double> growth(81, 0.02);
  for (std::size_t i = 26; i < 51; ++i) growth[i] = 0;
  // The step at 25 is seen again at 50, where the walker starts.
  EXPECT_THAT(completed({5, 10, 15, 20, 25, 50, 55, 60, 65, 70, 75, 80}, growth),
              ElementsAre(5, 10, 15, 20, 25, 55, 60, 65, 70, 75, 80));
}

TEST(CompleteSteps, LeavesAWalkOfNoKnownWayAlone) {
  EXPECT_THAT(completed({5}, std::vector<double>(20, 0.01)), ElementsAre(5));
  EXPECT_THAT(completed({}, std::vector<double>(20, 0.01)), testing::IsEmpty());
}

}  // namespace
