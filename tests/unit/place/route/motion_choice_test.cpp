#include "place/route/motion_choice.hpp"

#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/resolve.hpp>
#include <vo/base/error.hpp>

namespace {

using place::Settings;
using vo::Activity;

/// Seconds 25 frames a second: the picture grows throughout, and bounces by two steps a second while walked.
vo::Walk walk_of(double walked_s, double rolled_s, double rate_hz = 25) {
  vo::Walk walk;
  walk.source = "walk.mp4";
  const auto frames = static_cast<std::size_t>((walked_s + rolled_s) * rate_hz);
  for (std::size_t i = 0; i < frames; ++i) {
    const double s = static_cast<double>(i) / rate_hz;
    const double phase = s < walked_s ? 2 * std::numbers::pi * s : 0;
    walk.time_s.push_back(s);
    vo::FrameMotion& motion = walk.tracked.emplace_back();
    motion.matches = 200;
    motion.window = i == 0 ? 0 : 1;
    if (i == 0) continue;
    const double step_s = 1 / rate_hz;
    motion.orientation_deg = s < walked_s ? 4 * std::numbers::pi * std::sin(phase) * step_s : 0;
    motion.shift_px = 0.0;
    motion.turn = vo::Turn{.turn_rad = 0};
    motion.picture =
        vo::PictureMotion{.down_px = s < walked_s ? -16 * std::numbers::pi * std::cos(2 * phase) * step_s : 0,
                          .growth = 0.25 * step_s};
  }
  return walk;
}

Settings automatic(const Settings& given = {}) {
  Settings settings = given;
  settings.motion = "auto";
  return place::resolve(settings, {.purpose = place::Purpose::kRoute});
}

TEST(ShareOfGait, LeavesOutStandingAndCountsTheUnknownAsMotion) {
  vo::PedestrianMotion motion;
  EXPECT_EQ(place::share_of_gait(motion), 0);
  motion.activity = {{.time_s = 0, .activity = Activity::kStanding}};
  EXPECT_EQ(place::share_of_gait(motion), 0);
  motion.activity = {{0, Activity::kStanding}, {1, Activity::kWalking}, {2, Activity::kRunning},
                     {3, Activity::kUnknown},  {4, Activity::kRiding},  {5, Activity::kWalking}};
  EXPECT_DOUBLE_EQ(place::share_of_gait(motion), 3.0 / 5);
}

TEST(ChooseMotion, IsStepsWhereMostOfTheMotionIsGait) {
  const place::MotionChoice choice = place::choose_motion(automatic(), walk_of(60, 40), {});
  EXPECT_EQ(choice.settings.motion, "steps");
  EXPECT_GE(choice.gait_share, 0.58);  // less a second at either end
  EXPECT_LE(choice.gait_share, 0.75);  // steps are filled in over up to 10 s and a few
  EXPECT_EQ(choice.settings.spacing_m, 0.85);
  EXPECT_FALSE(choice.settings.sampling_n);
  EXPECT_FALSE(choice.settings.separations);  // of alignment error alone
  EXPECT_EQ(choice.settings.step_length, 0.7);
}

TEST(ChooseMotion, IsAlignmentErrorWhereItIsNot) {
  for (const vo::Walk& walk : {walk_of(10, 60), walk_of(30, 60), walk_of(0, 20), walk_of(20, 0, 5)}) {
    const place::MotionChoice choice = place::choose_motion(automatic(), walk, {});
    EXPECT_EQ(choice.settings.motion, "sad");
    EXPECT_LT(choice.gait_share, 0.5);
    EXPECT_EQ(choice.settings.sampling_n, 6);
    EXPECT_FALSE(choice.settings.spacing_m);
    EXPECT_FALSE(choice.settings.step_length);
    EXPECT_EQ(choice.settings.separations, 5);
  }
}

TEST(ChooseMotion, AnyGivenDensityCounts) {
  Settings given;
  given.sampling_n = 4;
  EXPECT_EQ(place::choose_motion(automatic(given), walk_of(30, 0), {}).settings.sampling_n, 4);
  EXPECT_EQ(place::choose_motion(automatic(given), walk_of(0, 30), {}).settings.sampling_n, 4);
  given = {};
  given.spacing_m = 0.5;
  EXPECT_EQ(place::choose_motion(automatic(given), walk_of(30, 0), {}).settings.spacing_m, 0.5);
  EXPECT_THROW_WITH(place::choose_motion(automatic(given), walk_of(0, 30), {}), vo::Error,
                    "walk.mp4: shows no steps, so its motion is not in metres; expected no spacing-m");
}

TEST(ChooseMotion, WantsAutoAndTrackedPoints) {
  Settings steps = automatic();
  steps.motion = "steps";
  EXPECT_THROW(place::choose_motion(steps, walk_of(10, 0), {}), std::invalid_argument);
  vo::Walk untracked = walk_of(10, 0);
  untracked.tracked.clear();
  EXPECT_THROW(place::choose_motion(automatic(), untracked, {}), std::invalid_argument);
}

}  // namespace
