#include "support/bouncing_walk.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/footfall.hpp>

namespace {

using test_support::BouncingWalk;
using testing::IsEmpty;
using testing::SizeIs;

vo::StepDetection detect(const BouncingWalk& walk, const std::vector<vo::Step>& legs = {}) {
  return vo::detect_footfalls(walk.bounce_px(), walk.growth(), walk.time_s(), walk.reliable(), legs);
}

TEST(DetectFootfalls, FindsEachStepAtItsEnd) {
  for (const double step_hz : {1.2, 1.9, 3.0}) {
    const BouncingWalk walk = BouncingWalk().walk(40.5, step_hz);
    const auto found = detect(walk);
    ASSERT_THAT(found.steps, SizeIs(40)) << step_hz;
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
      // Half a frame, and what noise of 1 % moves the flat top of a sinusoid by: a frame.
      EXPECT_NEAR(found.steps[i].time_s, static_cast<double>(i + 1) / step_hz, 0.07) << step_hz;
      EXPECT_EQ(found.steps[i].leg, i % 2 == 0 ? vo::Leg::kLeft : vo::Leg::kRight);
      EXPECT_FALSE(found.steps[i].bridged);
    }
    EXPECT_EQ(found.gait_share, 1);
  }
}

TEST(DetectFootfalls, CountsThoseInTheRecordingWhereverItIsCut) {
  for (const double begin : {0.1, 0.3, 0.7, 0.8}) {
    const BouncingWalk whole = BouncingWalk().walk(begin, 2).walk(20.5, 2);
    const auto cut = static_cast<std::ptrdiff_t>(std::lround(begin / 2 * BouncingWalk::kRate_hz));
    const auto rest = [cut](const auto& values) { return std::vector(values.begin() + cut, values.end()); };
    const auto found = vo::detect_footfalls(rest(whole.bounce_px()), rest(whole.growth()),
                                            rest(whole.time_s()), rest(whole.reliable()), {});
    EXPECT_THAT(found.steps, SizeIs(whole.steps())) << begin;  // one each time its phase is whole
  }
}

TEST(DetectFootfalls, HalfAStepBeforeAStandAndHalfAfterItAreOne) {
  // One stands with the feet together, half a step from either footfall.
  const BouncingWalk walk = BouncingWalk(0.5).stand(4).walk(20, 2).stand(4, 0.6).walk(20.2, 2).stand(4, 0.6);
  const auto found = detect(walk);
  EXPECT_THAT(found.steps, SizeIs(40));
  for (const vo::Step& step : found.steps) {
    const bool walked = (step.time_s > 4 && step.time_s < 14.1) || (step.time_s > 18 && step.time_s < 28.2);
    EXPECT_TRUE(walked) << step.time_s;
  }
}

TEST(DetectFootfalls, DoesNotCountTheSwingOutAfterTheLast) {
  // The feet come together at half a step; the trunk goes on to less than half the depth of a footfall while
  // the picture still grows a little.
  const BouncingWalk walk = BouncingWalk().walk(20.4, 2).walk(0.9, 2, 0.8, 0.003).stand(4);
  EXPECT_THAT(detect(walk).steps, SizeIs(20));
}

TEST(DetectFootfalls, LosesAndAddsNoneWhenTheWalkerSlowsDown) {
  const BouncingWalk walk = BouncingWalk().walk(20, 2.9).walk(20.3, 1.5);
  EXPECT_THAT(detect(walk).steps, SizeIs(walk.steps()));
}

TEST(DetectFootfalls, SeesNoneAtFramesThatAreNotReliable) {
  const BouncingWalk walk = BouncingWalk().walk(20.5, 2);
  std::vector<bool> reliable = walk.reliable();
  std::fill(reliable.begin() + 120, reliable.begin() + 131, false);  // the tenth falls at frame 125
  const auto found = vo::detect_footfalls(walk.bounce_px(), walk.growth(), walk.time_s(), reliable, {});
  ASSERT_THAT(found.steps, SizeIs(20));
  EXPECT_EQ(found.bridged, 1U);
  EXPECT_TRUE(found.steps[9].bridged);
}

TEST(DetectFootfalls, OfTwoValleysInHalfAStepCountsTheDeeper) {
  const BouncingWalk walk = BouncingWalk().walk(20.5, BouncingWalk::kRate_hz / 12);
  std::vector<double> bounce_px = walk.bounce_px();
  std::vector<std::size_t> deepest;
  for (std::size_t bottom = 11; bottom < 240; bottom += 12) {
    bounce_px[bottom] += 0.8;
    bounce_px[bottom - 1] += 0.4;
    deepest.push_back(bottom + 1);
  }
  const auto found = vo::detect_footfalls(bounce_px, walk.growth(), walk.time_s(), walk.reliable(), {});
  ASSERT_THAT(found.steps, SizeIs(20));
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(found.steps[i].frame, deepest[i]) << i;
}

TEST(DetectFootfalls, FindsNoneInAStand) {
  EXPECT_THAT(detect(BouncingWalk().stand(30)).steps, IsEmpty());
}

TEST(DetectFootfalls, FillsADarkStretchByTheWayInIt) {
  for (const int lost : {1, 2, 4}) {
    const BouncingWalk walk = BouncingWalk().walk(20, 2).dark(lost, 2).walk(20.5, 2);
    const auto found = detect(walk);
    EXPECT_THAT(found.steps, SizeIs(walk.steps())) << lost;
    EXPECT_EQ(static_cast<long>(found.bridged), std::ranges::count(found.steps, true, &vo::Step::bridged));
    EXPECT_NEAR(static_cast<double>(found.bridged), lost, 1);  // the one at its edge may be seen or not
  }
}

TEST(DetectFootfalls, TakesTheLegsFromTheRoll) {
  const BouncingWalk walk = BouncingWalk().walk(20.5, 2);
  // The camera rolls fastest 0.2 s before the foot lands; the first is a right one, and one is wrong.
  std::vector<vo::Step> legs;
  for (std::size_t i = 0; i < 20; ++i) {
    const double time_s = static_cast<double>(i + 1) / 2 - 0.2;
    legs.push_back({static_cast<std::size_t>(time_s * 25), time_s,
                    i % 2 == 0 || i == 7 ? vo::Leg::kRight : vo::Leg::kLeft, 1, false});
  }
  const auto found = detect(walk, legs);
  ASSERT_THAT(found.steps, SizeIs(20));
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_EQ(found.steps[i].leg, i % 2 == 0 ? vo::Leg::kRight : vo::Leg::kLeft) << i;
}

TEST(DetectFootfalls, OfEmptyShortAndConstantSignals) {
  for (const std::size_t frames : {0U, 1U, 2U, 3U, 200U}) {
    std::vector<double> time_s(frames);
    for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / 25;
    const auto found =
        vo::detect_footfalls(std::vector<double>(frames, -1), std::vector<double>(frames, 0.01), time_s,
                             std::vector<bool>(frames, true), {});
    EXPECT_THAT(found.steps, IsEmpty()) << frames;
    EXPECT_THAT(found.delta_dyn, SizeIs(frames));
  }
}

TEST(DetectFootfalls, RefusesWhatMakesNoSense) {
  const std::vector<double> values(10, 0.0), few(9, 0.0);
  const std::vector<bool> reliable(10, true);
  EXPECT_THROW(vo::detect_footfalls(values, few, values, reliable, {}), std::invalid_argument);
  EXPECT_THROW(vo::detect_footfalls(values, values, values, reliable, {}, {.min_depth = 0}),
               std::invalid_argument);
  EXPECT_THROW(
      vo::detect_footfalls(values, values, values, reliable, {}, {.min_depth = 0.3, .sure_depth = 0.2}),
      std::invalid_argument);
}

}  // namespace
