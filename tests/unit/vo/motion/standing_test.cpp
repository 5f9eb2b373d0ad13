#include "support/random_images.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>
#include <vo/image/patch_normalisation.hpp>
#include <vo/motion/alignment_error.hpp>
#include <vo/motion/standing.hpp>

namespace {

using test_support::random_images;
using testing::Each;
using testing::IsEmpty;

/// Frames at 8 Hz, whose times have no rounding in them: the default span of 2 s is 16 frames.
std::vector<double> times(std::size_t frames) {
  std::vector<double> time_s(frames);
  for (std::size_t i = 0; i < frames; ++i) time_s[i] = static_cast<double>(i) / 8;
  return time_s;
}

/// Unlike pictures throughout, but for frames [begin, end), which show one picture that sways by a few grey
/// levels.
vo::ImageStack walk_with_a_stop(std::size_t frames, std::size_t begin, std::size_t end) {
  vo::ImageStack walk = random_images(16, 8, frames, 1);
  const std::vector<std::uint8_t> view(walk[begin].begin(), walk[begin].end());
  for (std::size_t i = begin; i < end; ++i) {
    std::ranges::transform(view, walk[i].begin(), [&](std::uint8_t pixel) {
      return static_cast<std::uint8_t>(std::clamp(pixel + static_cast<int>(i % 5) - 2, 0, 255));
    });
  }
  return walk;
}

TEST(DistantError, WorkedExample) {
  // Half the walk apart: |128 - 144|, |128 - 160|, |128 - 192| steps; the median is 32 steps, 2 deviations.
  const vo::ImageStack walk{.width = 1, .height = 1, .pixels = {128, 128, 128, 144, 160, 192}};
  EXPECT_EQ(vo::distant_error(walk), 2);
}

TEST(DistantError, OfUnrelatedNormalPicturesIsAsStated) {
  vo::Rng rng(2);
  vo::ImageStack walk = vo::make_image_stack(64, 32, 40);
  for (auto& pixel : walk.pixels)
    pixel = static_cast<std::uint8_t>(std::clamp(std::lround(128 + 16 * rng.normal()), 0L, 255L));
  // Each of the 20 errors is a mean of 2048 terms of deviation 0.85, so deviates by 0.019; their median by
  // less. Three of that.
  EXPECT_NEAR(vo::distant_error(walk), 2 / std::sqrt(std::numbers::pi), 0.057);
}

/// A walk that goes round the same way several times.
vo::ImageStack in_rounds(const vo::ImageStack& once, int rounds) {
  vo::ImageStack walk = once;
  for (int i = 1; i < rounds; ++i)
    walk.pixels.insert(walk.pixels.end(), once.pixels.begin(), once.pixels.end());
  return walk;
}

TEST(DistantError, OfAWalkInRoundsIsThatOfOnce) {
  const vo::ImageStack once = random_images(16, 8, 60, 1);
  const double unlike = vo::distant_error(once);
  for (const int rounds : {2, 3, 4, 6})
    EXPECT_NEAR(vo::distant_error(in_rounds(once, rounds)), unlike, 0.1 * unlike) << rounds;
}

TEST(FindPauses, SeesAStopOfAWalkInRounds) {
  const auto pauses = vo::find_pauses(in_rounds(walk_with_a_stop(100, 40, 70), 2), times(200));
  EXPECT_FALSE(pauses.still);
  ASSERT_EQ(pauses.standing.size(), 200U);
  for (std::size_t i = 0; i < 200; ++i) EXPECT_EQ(pauses.standing[i], i % 100 >= 41 && i % 100 <= 69) << i;
}

TEST(DistantError, LeavesFramesOut) {
  const vo::ImageStack walk{.width = 1, .height = 1, .pixels = {128, 0, 128, 128, 255, 144, 160, 192}};
  EXPECT_EQ(vo::distant_error(walk, {false, true, false, false, true, false, false, false}), 2);
  EXPECT_EQ(vo::distant_error(walk, std::vector<bool>(8, true)), 0);
  EXPECT_THROW(vo::distant_error(walk, {true}), std::invalid_argument);
}

TEST(DistantError, OfFewerThanTwoFramesIsZero) {
  EXPECT_EQ(vo::distant_error(random_images(4, 4, 0, 1)), 0);
  EXPECT_EQ(vo::distant_error(random_images(4, 4, 1, 1)), 0);
  EXPECT_GT(vo::distant_error(random_images(4, 4, 2, 1)), 0);
}

TEST(StandingStill, IsBelowAThirdOfUnrelatedPictures) {
  EXPECT_TRUE(vo::standing_still(0));
  EXPECT_TRUE(vo::standing_still(0.376));  // a third of 1.1284 is 0.37613
  EXPECT_FALSE(vo::standing_still(0.3762));
}

TEST(StandingFrames, AreThoseOfAPlantedStop) {
  // The walker arrives at frame 40 and leaves after frame 79: the steps to 41 .. 79 are standing.
  const auto walk = walk_with_a_stop(120, 40, 80);
  const auto standing = vo::standing_frames(walk, times(120), vo::distant_error(walk));
  ASSERT_EQ(standing.size(), 120U);
  for (std::size_t i = 0; i < 120; ++i) EXPECT_EQ(standing[i], i >= 41 && i <= 79) << i;
}

TEST(StandingFrames, ReachTheEndsOfTheWalk) {
  const auto start = walk_with_a_stop(100, 0, 40);
  const auto at_start = vo::standing_frames(start, times(100), vo::distant_error(start));
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(at_start[i], i >= 1 && i <= 39) << i;
  const auto end = walk_with_a_stop(100, 60, 100);
  const auto at_end = vo::standing_frames(end, times(100), vo::distant_error(end));
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(at_end[i], i >= 61) << i;
}

TEST(StandingFrames, DoNotSeeAStopShorterThanTheSpan) {
  const auto walk = walk_with_a_stop(120, 40, 55);  // 1.75 s
  const double unlike = vo::distant_error(walk);
  EXPECT_THAT(vo::standing_frames(walk, times(120), unlike), Each(false));
  const auto shorter_span = vo::standing_frames(walk, times(120), unlike, {.span_s = 1});
  EXPECT_EQ(std::ranges::count(shorter_span, true), 14);
  EXPECT_THAT(vo::standing_frames(walk, times(120), unlike, {.span_s = 0}), Each(false));
}

TEST(StandingFrames, ArePassedOverWhereOnlyTheEndsOfASpanAreAlike) {
  // The same picture every 2 s and unlike ones between, as along a fence.
  vo::ImageStack walk = random_images(16, 8, 100, 3);
  for (std::size_t i = 16; i < 100; i += 16) std::ranges::copy(walk[0], walk[i].begin());
  EXPECT_THAT(vo::standing_frames(walk, times(100), vo::distant_error(walk)), Each(false));
  // With the middle ones alike as well, a span is found; its steps count whatever lies between.
  for (std::size_t i = 8; i < 100; i += 16) std::ranges::copy(walk[0], walk[i].begin());
  EXPECT_EQ(std::ranges::count(vo::standing_frames(walk, times(100), vo::distant_error(walk)), true), 96);
}

TEST(StandingFrames, SayNothingOfPicturesOfNothing) {
  // Black for 5 s, a trace of noise in it, between walking; and a stop of 5 s that goes black for the last 2.
  vo::ImageStack walk = walk_with_a_stop(160, 100, 140);
  for (std::size_t i = 40; i < 80; ++i)
    std::ranges::fill(walk[i], static_cast<std::uint8_t>(vo::kNeutralByte + i % 2));
  for (std::size_t i = 124; i < 140; ++i) std::ranges::fill(walk[i], vo::kNeutralByte);
  const auto standing = vo::standing_frames(walk, times(160), vo::distant_error(walk));
  for (std::size_t i = 0; i < 160; ++i) EXPECT_EQ(standing[i], i >= 101 && i <= 123) << i;
}

/// Unrelated pictures of normal pixels, but for frames [40, end), which turn from one towards another by an
/// angle: two of them an angle d apart differ by sqrt(2) sin(d / 2) times what unrelated ones do.
template <typename Angle>
vo::ImageStack turning_view(Angle angle_rad, std::size_t frames = 120, std::size_t end = 80) {
  constexpr std::size_t kPixels = 64 * 32;
  vo::Rng rng(3);
  const auto byte = [](double x) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(128 + 16 * x), 0L, 255L));
  };
  vo::ImageStack walk = vo::make_image_stack(64, 32, frames);
  for (auto& pixel : walk.pixels) pixel = byte(rng.normal());
  std::vector<double> a(kPixels), b(kPixels);
  for (double& x : a) x = rng.normal();
  for (double& x : b) x = rng.normal();
  for (std::size_t i = 40; i < end; ++i) {
    const double angle = angle_rad(static_cast<double>(i - 40));
    for (std::size_t k = 0; k < kPixels; ++k)
      walk[i][k] = byte(std::cos(angle) * a[k] + std::sin(angle) * b[k]);
  }
  return walk;
}

TEST(StandingFrames, AreNotThoseOfASlowWalkThroughAViewThatChangesLittle) {
  // By half of what unrelated pictures differ in the 16 frames of 2 s, and by a quarter in 1 s.
  const double rate = 2 * std::asin(0.5 / std::numbers::sqrt2) / 16;
  const auto walk = turning_view([&](double i) { return rate * i; });
  const double unlike = vo::distant_error(walk);
  EXPECT_THAT(vo::standing_frames(walk, times(120), unlike), Each(false));
}

TEST(StandingFrames, AreThoseOfAWalkerWhoSwaysFarButForLong) {
  // To and fro by six tenths of what unrelated pictures differ, for 20 s and for 5 s. A third of a period is
  // half of the span, so that of its three views two always differ by 0.45 or more.
  const double most = 2 * std::asin(0.6 / std::numbers::sqrt2);
  const auto sway = [&](double i) { return most / 2 * std::sin(2 * std::numbers::pi * i / 24); };
  for (const std::size_t end : {200U, 80U}) {
    const auto walk = turning_view(sway, 240, end);
    const auto standing = vo::standing_frames(walk, times(240), vo::distant_error(walk));
    for (std::size_t i = 0; i < 240; ++i) EXPECT_EQ(standing[i], end == 200 && i >= 41 && i < end) << i;
  }
}

TEST(StandingFrames, AreThoseOfAWalkerWhoSways) {
  // To and fro by a third of what unrelated pictures differ, in 20 frames.
  const double most = 2 * std::asin(1.0 / 3 / std::numbers::sqrt2);
  const auto walk =
      turning_view([&](double i) { return most / 2 * std::sin(2 * std::numbers::pi * i / 20); });
  const auto standing = vo::standing_frames(walk, times(120), vo::distant_error(walk));
  for (std::size_t i = 0; i < 120; ++i) EXPECT_EQ(standing[i], i >= 41 && i <= 79) << i;
}

TEST(StandingFrames, GoByTimeNotByFrames) {
  // 1 Hz: a span of 2 s is 2 frames.
  const auto walk = walk_with_a_stop(12, 4, 8);
  std::vector<double> time_s(12);
  for (std::size_t i = 0; i < 12; ++i) time_s[i] = static_cast<double>(i);
  const auto standing = vo::standing_frames(walk, time_s, vo::distant_error(walk));
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(standing[i], i >= 5 && i <= 7) << i;
}

TEST(StandingFrames, AreNotFoundOverAJumpOfTheClock) {
  // One view in all of the frames around the jump, too short on both sides to be a stand.
  const auto walk = walk_with_a_stop(120, 50, 70);
  std::vector<double> time_s = times(120);
  for (std::size_t i = 60; i < 120; ++i) time_s[i] += 5;
  EXPECT_THAT(vo::standing_frames(walk, time_s, vo::distant_error(walk)), Each(false));
}

TEST(FindStands, AreThoseOfStandingStepsWhereMostOfTheWalkMoves) {
  const auto walk = walk_with_a_stop(120, 40, 80);
  const vo::Pauses pauses = vo::find_pauses(walk, times(120));
  EXPECT_FALSE(pauses.still);
  EXPECT_EQ(pauses.distant_error, vo::distant_error(walk));
  EXPECT_EQ(pauses.standing, vo::standing_frames(walk, times(120), pauses.distant_error));
}

TEST(FindStands, AreFoundWhereMostOfTheWalkStands) {
  // Frames half the walk apart show one view.
  const auto walk = walk_with_a_stop(400, 30, 380);
  EXPECT_TRUE(vo::standing_still(vo::distant_error(walk)));
  const vo::Pauses pauses = vo::find_pauses(walk, times(400));
  EXPECT_FALSE(pauses.still);
  ASSERT_EQ(pauses.standing.size(), 400U);
  for (std::size_t i = 0; i < 400; ++i) EXPECT_EQ(pauses.standing[i], i >= 31 && i <= 379) << i;
}

TEST(FindStands, SayThatAWalkNeverLeavesItsFirstView) {
  const vo::Pauses pauses = vo::find_pauses(walk_with_a_stop(100, 0, 100), times(100));
  EXPECT_TRUE(pauses.still);
  EXPECT_THAT(pauses.standing, IsEmpty());
  EXPECT_TRUE(vo::find_pauses(random_images(4, 4, 0, 1), {}).still);
  EXPECT_TRUE(vo::find_pauses(random_images(4, 4, 1, 1), times(1)).still);
}

TEST(StandingFrames, OfEmptyAndMismatchedInput) {
  EXPECT_THAT(vo::standing_frames(random_images(4, 4, 0, 1), {}, 1), IsEmpty());
  EXPECT_THAT(vo::standing_frames(random_images(4, 4, 1, 1), times(1), 1), testing::ElementsAre(false));
  EXPECT_THROW(vo::standing_frames(random_images(4, 4, 2, 1), times(3), 1), std::invalid_argument);
}

TEST(StandingFrames, AreTheSameForAnyThreadCount) {
  const auto walk = walk_with_a_stop(120, 40, 80);
  vo::set_thread_count(1);
  const auto one = vo::standing_frames(walk, times(120), 1);
  vo::set_thread_count(4);
  EXPECT_EQ(vo::standing_frames(walk, times(120), 1), one);
  vo::set_thread_count(0);
}

}  // namespace
