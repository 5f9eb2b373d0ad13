#include "route/keyframe_check.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace {

using place::Keyframe;
using place::problem_of;

TEST(KeyframeCheck, FindsWhatKeyframesCannotBe) {
  const std::vector<Keyframe> right{{.frame = 0},
                                    {.frame = 5, .time_s = 0.2, .displacement = 1, .after_gap = true},
                                    {.frame = 6, .time_s = 0.2, .displacement = 0.5, .distance_m = -1}};
  EXPECT_EQ(problem_of({}), "");
  EXPECT_EQ(problem_of(right), "");
  const auto with = [&](std::size_t i, auto change) {
    std::vector<Keyframe> keyframes = right;
    change(keyframes[i]);
    return problem_of(keyframes);
  };
  EXPECT_EQ(with(0, [](Keyframe& k) { k.frame = -1; }), "keyframes are not in order");
  EXPECT_EQ(with(0, [](Keyframe& k) { k.after_gap = true; }), "keyframes are not in order");
  EXPECT_EQ(with(1, [](Keyframe& k) { k.frame = 0; }), "keyframes are not in order");
  EXPECT_EQ(with(2, [](Keyframe& k) { k.time_s = 0.1; }), "keyframes are not in order");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double none : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(with(1, [&](Keyframe& k) { k.time_s = none; }), "a value of a keyframe is no number");
    EXPECT_EQ(with(1, [&](Keyframe& k) { k.displacement = none; }), "a value of a keyframe is no number");
    EXPECT_EQ(with(1, [&](Keyframe& k) { k.distance_m = none; }), "a value of a keyframe is no number");
    EXPECT_EQ(with(1,
                   [&](Keyframe& k) {
                     k.pose = vo::Pose2{0, none, 0};
                   }),
              "a value of a keyframe is no number");
  }
}

}  // namespace
