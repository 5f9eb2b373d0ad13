#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/gait/step_fusion.hpp>

namespace {

using testing::ElementsAre;

constexpr double kRate_hz = 25;

/// Steps half a second apart from `begin_s` on, left and right.
vo::StepDetection steps(double begin_s, std::size_t count) {
  vo::StepDetection detection;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = begin_s + 0.5 * static_cast<double>(i);
    detection.steps.push_back({.frame = static_cast<std::size_t>(time_s * kRate_hz),
                               .time_s = time_s,
                               .leg = i % 2 == 0 ? vo::Leg::kLeft : vo::Leg::kRight});
  }
  return detection;
}

/// Ten seconds with 200 matches in each frame, and 20 from `poor_s` on.
struct Frames {
  explicit Frames(double poor_s) {
    for (int i = 0; i < 250; ++i) {
      time_s.push_back(i / kRate_hz);
      matches.push_back(time_s.back() < poor_s ? 200 : 20);
    }
  }
  std::vector<double> time_s;
  std::vector<std::size_t> matches;
};

std::vector<double> times(const vo::StepDetection& detection) {
  std::vector<double> result;
  for (const vo::Step& step : detection.steps) result.push_back(step.time_s);
  return result;
}

TEST(FillSteps, TakesTheOthersWherePointsAreFew) {
  const Frames frames(7);
  const auto filled = vo::fill_steps(steps(1, 12), steps(0.6, 18), frames.matches, frames.time_s);
  // 1 ... 6.5 are the first's; of 0.6 ... 9.1 those from 7 s on are in the dark.
  EXPECT_THAT(times(filled),
              ElementsAre(1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5, 5.5, 6, 6.5, 7.1, 7.6, 8.1, 8.6, 9.1));
  for (std::size_t i = 1; i < filled.steps.size(); ++i)
    EXPECT_NE(filled.steps[i].leg, filled.steps[i - 1].leg);
}

TEST(FillSteps, CountsNoStepTwice) {
  const Frames frames(7);
  EXPECT_THAT(times(vo::fill_steps(steps(7.1, 2), steps(7, 4), frames.matches, frames.time_s)),
              ElementsAre(7.1, 7.6, 8, 8.5));
}

TEST(FillSteps, LeavesWellSeenWalksAlone) {
  const Frames frames(100);
  EXPECT_THAT(times(vo::fill_steps(steps(1, 2), steps(5, 4), frames.matches, frames.time_s)),
              ElementsAre(1, 1.5));
  EXPECT_TRUE(vo::fill_steps({}, steps(5, 4), Frames(0).matches, frames.time_s).steps.empty());
  EXPECT_TRUE(vo::fill_steps({}, {}, {}, {}).steps.empty());
  EXPECT_THROW(vo::fill_steps({}, {}, frames.matches, {}), std::invalid_argument);
}

}  // namespace
