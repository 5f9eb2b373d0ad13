#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/clock.hpp>
#include <vo/base/rng.hpp>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using vo::ClockGap;

/// 20 s at 25 frames/s, the clock of which jumps by so much at frames 100 and 300.
std::vector<double> jumping(double first_s, double second_s) {
  std::vector<double> time_s;
  for (int i = 0; i < 500; ++i)
    time_s.push_back(i / 25.0 + (i >= 100 ? first_s : 0) + (i >= 300 ? second_s : 0));
  return time_s;
}

TEST(FrameRate, IsThatOfTheUsualInterval) {
  EXPECT_DOUBLE_EQ(vo::frame_rate_hz(std::vector<double>{0, 0.25, 0.5, 2.5, 2.75}), 4);
  EXPECT_DOUBLE_EQ(vo::frame_rate_hz(std::vector<double>{0, 1, 5}), 1 / 2.5);
  EXPECT_THROW(vo::frame_rate_hz(std::vector<double>{1}), std::invalid_argument);
}

TEST(FrameRate, IsNotThatOfTheRounding) {
  // 29.97 frames/s in whole milliseconds: 33, 33, 34, ...
  std::vector<double> time_s;
  for (int i = 0; i < 3000; ++i) time_s.push_back(std::floor(i * 1001.0 / 30) / 1000);
  EXPECT_NEAR(vo::frame_rate_hz(time_s), 30 / 1.001, 1e-3);
}

TEST(ClockGaps, AreTheJumps) {
  EXPECT_THAT(vo::clock_gaps(jumping(0, 0)), IsEmpty());
  EXPECT_THAT(vo::clock_gaps(jumping(0.4, 0)), IsEmpty());
  const auto gaps = vo::clock_gaps(jumping(0.5, 3600));
  ASSERT_EQ(gaps.size(), 2U);
  EXPECT_EQ(gaps[0].frame, 100U);
  EXPECT_NEAR(gaps[0].length_s, 0.54, 1e-9);
  EXPECT_FALSE(vo::parts_walk(gaps[0]));
  EXPECT_EQ(gaps[1].frame, 300U);
  EXPECT_NEAR(gaps[1].length_s, 3600.04, 1e-9);
  EXPECT_TRUE(vo::parts_walk(gaps[1]));
}

TEST(ClockGaps, AreNoneWhereFramesAreAlwaysSeconds) {
  std::vector<double> slow;
  for (int i = 0; i < 20; ++i) slow.push_back(2.0 * i);
  EXPECT_THAT(vo::clock_gaps(slow), IsEmpty());
  slow.back() += 8;
  EXPECT_THAT(vo::clock_gaps(slow), ElementsAre(ClockGap{19, 10}));
  EXPECT_THAT(vo::clock_gaps({}), IsEmpty());
  EXPECT_THAT(vo::clock_gaps(std::vector<double>{3}), IsEmpty());
}

TEST(WithoutLongGaps, ShortensThoseAlone) {
  const auto time_s = jumping(2, 3600);
  const auto shortened = vo::without_long_gaps(time_s);
  for (std::size_t i = 0; i < 300; ++i) EXPECT_EQ(shortened[i], time_s[i]);
  EXPECT_NEAR(shortened[300] - shortened[299], vo::kLongestFilledGap_s, 1e-9);
  for (std::size_t i = 301; i < 500; ++i) EXPECT_NEAR(shortened[i] - shortened[i - 1], 0.04, 1e-9);
  EXPECT_THAT(vo::without_long_gaps({}), IsEmpty());
}

TEST(FillGapsByPace, IsTheMeanPaceAroundThem) {
  // A metre a second before, two after.
  for (const double jump_s : {0.6, 2.9, 3.0}) {
    const auto time_s = jumping(jump_s, 0);
    std::vector<double> moved(500);
    for (std::size_t i = 1; i < 500; ++i) moved[i] = (i <= 100 ? 1.0 : 2.0) / 25;
    const auto gaps = vo::clock_gaps(time_s);
    vo::fill_gaps_by_pace(time_s, gaps, moved);
    EXPECT_NEAR(moved[100], jump_s + 0.04 > 3 ? 0 : 1.5 * (jump_s + 0.04), 1e-9);
    EXPECT_EQ(moved[99], 1.0 / 25);
    EXPECT_EQ(moved[101], 2.0 / 25);
  }
}

TEST(FillGapsByPace, GoesByWhatThereIsOnEitherSide) {
  // A gap before the last frame, after the first, and two next to each other.
  const std::vector<double> last{0, 0.5, 1, 1.5, 2, 4}, first{0, 2, 2.5, 3, 3.5, 4}, beside{0, 2, 4, 4.5, 5};
  std::vector<double> moved{9, 1, 1, 1, 1, 9};
  vo::fill_gaps_by_pace(last, std::vector<ClockGap>{{5, 2}}, moved);
  EXPECT_THAT(moved, ElementsAre(9, 1, 1, 1, 1, 4));
  moved = {9, 9, 1, 1, 1, 1};
  vo::fill_gaps_by_pace(first, std::vector<ClockGap>{{1, 2}}, moved);
  EXPECT_THAT(moved, ElementsAre(9, 4, 1, 1, 1, 1));
  moved = {9, 9, 9, 1, 1};
  vo::fill_gaps_by_pace(beside, std::vector<ClockGap>{{1, 2}, {2, 2}}, moved);
  EXPECT_THAT(moved, ElementsAre(9, 0, 4, 1, 1));  // nothing is known beside the first
  std::vector<double> none;
  vo::fill_gaps_by_pace({}, {}, none);
  EXPECT_THROW(vo::fill_gaps_by_pace(last, {}, none), std::invalid_argument);
}

}  // namespace
