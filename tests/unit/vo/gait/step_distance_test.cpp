#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/step_distance.hpp>

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
  const vo::StepDistance walked(growth, time_s, frames);
  std::vector<std::size_t> found;
  for (const vo::Step& step : vo::complete_steps(steps_at(frames, time_s), walked, growth, time_s).steps)
    found.push_back(step.frame);
  return found;
}

TEST(StepDistance, WorkedExample) {
  std::vector<double> growth(41, 0.02);
  for (std::size_t i = 21; i < 31; ++i) growth[i] = 0.005;  // a quarter as fast: half the cadence
  for (std::size_t i = 31; i < 41; ++i) growth[i] = 0.001;  // 5 %: stands
  const auto time_s = seconds(41);
  const std::vector<std::size_t> frames{5, 10, 15, 20};
  const vo::StepDistance walked(growth, time_s, frames);
  ASSERT_TRUE(walked.known());
  EXPECT_NEAR(walked.step_s(10), 0.5, 1e-12);  // rounding, as below
  EXPECT_NEAR(walked.between(5, 20), 3, 1e-9);
  EXPECT_NEAR(walked.between(20, 28), 8 * 0.5 / 5, 1e-9);
  EXPECT_EQ(walked.between(30, 40), 0);
  EXPECT_EQ(walked.after(5, 2), 15U);
  EXPECT_EQ(walked.after(20, 0.5), 25U);
  EXPECT_EQ(walked.after(30, 1), 40U);  // not reached
  EXPECT_TRUE(walked.walking(10));
  EXPECT_FALSE(walked.walking(36));
  EXPECT_FALSE(walked.gap(10, 15));
  EXPECT_TRUE(walked.gap(10, 18));  // 0.8 s are more than one and a half steps of 0.5 s
}

TEST(StepDistance, IsNoneInAStandThatSways) {
  std::vector<double> growth(61, 0.02);
  // To and fro, by a quarter of the usual growth, twice in the time of a step.
  for (std::size_t i = 21; i < 41; ++i) growth[i] = i % 2 == 0 ? 0.005 : -0.005;
  const auto time_s = seconds(61);
  const vo::StepDistance walked(growth, time_s, std::vector<std::size_t>{5, 10, 15, 20, 45, 50, 55, 60});
  EXPECT_EQ(walked.between(23, 38), 0);
  // The step after it, and at each end of the stand up to two frames at half the cadence.
  EXPECT_NEAR(walked.between(20, 45), 1.2, 0.21);
}

TEST(StepDistance, GoesOnWhereThePictureTurnsFromGrowthToShrinking) {
  std::vector<double> growth(61, 0.02);
  for (std::size_t i = 21; i < 41; ++i)
    growth[i] = 0.02 * std::cos(std::numbers::pi * (static_cast<double>(i) - 20) / 10);
  const auto time_s = seconds(61);
  const vo::StepDistance walked(growth, time_s, std::vector<std::size_t>{5, 10, 15, 20, 45, 50, 55, 60});
  // The frames about 0 count whole; the others, at less than half the growth, by its square root.
  EXPECT_NEAR(walked.between(20, 45), 4.8, 0.2);
}

TEST(StepDistance, IsMeasuredByTheStepsNearest) {
  // Beyond a stand, all is three times as far away.
  std::vector<double> growth(101, 0.03);
  for (std::size_t i = 51; i < 101; ++i) growth[i] = i < 61 ? 0 : 0.01;
  const auto time_s = seconds(101);
  const vo::StepDistance walked(
      growth, time_s,
      std::vector<std::size_t>{5, 10, 15, 20, 25, 30, 35, 40, 45, 65, 70, 75, 80, 85, 90, 95, 100});
  EXPECT_NEAR(walked.between(45, 50), 1, 1e-9);  // rounding
  EXPECT_NEAR(walked.between(60, 65), 1, 1e-9);
  EXPECT_EQ(walked.between(51, 60), 0);
}

TEST(StepDistance, StepsOfASlowerPaceAreNotGaps) {
  const std::vector<double> growth(57, 0.02);
  const auto time_s = seconds(57);
  const vo::StepDistance walked(growth, time_s,
                                std::vector<std::size_t>{4, 8, 12, 16, 20, 24, 32, 40, 48, 56});
  EXPECT_FALSE(walked.gap(24, 32));
  EXPECT_NEAR(walked.step_s(28), 0.6, 1e-9);  // of the six nearest, three take 0.4 s and three 0.8 s
  // Twice as long as those before and after, it is one.
  const vo::StepDistance lost(growth, time_s, std::vector<std::size_t>{4, 8, 12, 16, 24, 28, 32, 36, 40});
  EXPECT_TRUE(lost.gap(16, 24));
  EXPECT_NEAR(lost.step_s(20), 0.4, 1e-9);
}

TEST(StepDistance, IsAsLongAsThereWasTimeForWhereThePictureNeverGrows) {
  const auto time_s = seconds(31);
  for (const double none : {0.0, -0.01}) {
    const std::vector<double> growth(31, none);
    const vo::StepDistance walked(growth, time_s, std::vector<std::size_t>{5, 10, 15, 20});
    EXPECT_NEAR(walked.between(20, 30), 2, 1e-9) << none;  // rounding
  }
}

TEST(StepDistance, OfOneStepIsNotKnown) {
  const std::vector<double> growth(10, 0.01);
  const auto time_s = seconds(10);
  EXPECT_FALSE(vo::StepDistance(growth, time_s, std::vector<std::size_t>{5}).known());
  EXPECT_FALSE(vo::StepDistance(growth, time_s, std::vector<std::size_t>{}).known());
}

TEST(CompleteSteps, FillsWhatWasLost) {
  const std::vector<double> growth(51, 0.02);
  EXPECT_THAT(completed({5, 10, 15, 20, 30, 35, 40, 45, 50}, growth),
              ElementsAre(5, 10, 15, 20, 25, 30, 35, 40, 45, 50));
  // Two before the first, and at the end the one at 45: the next would be done as the recording ends, and may
  // not be seen.
  EXPECT_THAT(completed({14, 19, 24, 29, 34, 39}, growth), ElementsAre(4, 9, 14, 19, 24, 29, 34, 39, 44));
}

TEST(CompleteSteps, LeavesWhatWasBegunBeforeAndWhatIsNotDone) {
  // Wherever it is cut, up to a step lies before the first footfall and after the last.
  for (const std::size_t first : {1U, 3U, 6U})
    EXPECT_THAT(completed({first, first + 5, first + 10, first + 15}, std::vector<double>(first + 21, 0.02)),
                ElementsAre(first, first + 5, first + 10, first + 15));
}

TEST(CompleteSteps, ShowsWhatIsMadeOfThoseAtTheEnds) {
  const std::vector<double> growth(22, 0.02);
  const auto time_s = seconds(22);
  const std::vector<std::size_t> frames{3, 8, 13, 18};
  const auto all =
      vo::complete_steps(steps_at(frames, time_s), vo::StepDistance(growth, time_s, frames), growth, time_s);
  EXPECT_NEAR(all.partial.first, 3 / 5.0, 1e-9);  // rounding
  EXPECT_NEAR(all.partial.after, 3 / 5.0, 1e-9);
  EXPECT_NEAR(vo::steps_made(all), 21 / 5.0, 1e-9);
  EXPECT_EQ(vo::steps_made({}), 0);
}

TEST(CompleteSteps, StandsWhereTheWalkerWalked) {
  // A step to a halt, a stand, and a step from it, none of them seen but the last.
  std::vector<double> growth(81, 0.02);
  for (std::size_t i = 31; i < 56; ++i) growth[i] = 0;
  EXPECT_THAT(completed({5, 10, 15, 20, 60, 65, 70, 75, 80}, growth),
              ElementsAre(5, 10, 15, 20, 25, 30, 60, 65, 70, 75, 80));
}

TEST(CompleteSteps, LegsOfBridgedStepsAlternate) {
  const std::vector<double> growth(51, 0.02);
  const auto time_s = seconds(51);
  const std::vector<std::size_t> frames{14, 19, 24, 34, 39};
  vo::StepDetection seen = steps_at(frames, time_s);
  for (std::size_t i = 0; i < frames.size(); ++i)
    seen.steps[i].leg = frames[i] % 2 == 0 ? vo::Leg::kRight : vo::Leg::kLeft;
  const auto all = vo::complete_steps(seen, vo::StepDistance(growth, time_s, frames), growth, time_s);
  ASSERT_THAT(all.steps, testing::SizeIs(9));
  EXPECT_EQ(all.bridged, 4U);
  for (std::size_t i = 1; i < all.steps.size(); ++i) EXPECT_NE(all.steps[i].leg, all.steps[i - 1].leg) << i;
}

TEST(CompleteSteps, KeepsTheLargerOfTwoWithNoDistanceBetweenThem) {
  std::vector<double> growth(81, 0.02);
  for (std::size_t i = 26; i < 51; ++i) growth[i] = 0;
  // The step at 25 is seen again at 50, where the walker starts.
  const std::vector<std::size_t> frames{5, 10, 15, 20, 25, 50, 55, 60, 65, 70, 75, 80};
  const auto time_s = seconds(81);
  for (const double again : {-0.9, -1.1}) {
    vo::StepDetection seen = steps_at(frames, time_s);
    seen.steps[5].value = again;
    const auto all = vo::complete_steps(seen, vo::StepDistance(growth, time_s, frames), growth, time_s);
    ASSERT_THAT(all.steps, testing::SizeIs(11));
    EXPECT_EQ(all.steps[4].frame, again == -0.9 ? 25U : 50U);
  }
}

TEST(CompleteSteps, LeavesAWalkOfNoKnownWayAlone) {
  EXPECT_THAT(completed({5}, std::vector<double>(20, 0.01)), ElementsAre(5));
  EXPECT_THAT(completed({}, std::vector<double>(20, 0.01)), testing::IsEmpty());
}

}  // namespace
