#include "support/synthetic_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/rng.hpp>
#include <vo/image/patch_normalisation.hpp>
#include <vo/motion/motion_follower.hpp>

namespace {

using namespace test_support;

std::vector<vo::FollowedMotion> follow(const std::vector<double>& place_px,
                                       const vo::MotionFollowerOptions& options = {}) {
  const vo::Walk walk = Wall(2000, 1).walk(place_px);
  const vo::ImageStack normalised = vo::patch_normalise(walk.thumbnails, {});
  vo::MotionFollower follower(options);
  std::vector<vo::FollowedMotion> all;
  for (std::size_t i = 0; i < walk.frames(); ++i) all.push_back(follower.push(normalised[i], walk.time_s[i]));
  return all;
}

double moved_s(const std::vector<vo::FollowedMotion>& motion, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += motion[i].moved_s;
  return sum;
}

TEST(MotionFollower, TakesTheMeanSpeedUntilItHasLearned) {
  const auto motion = follow(places(0, std::vector<double>(60, 1.0)));
  EXPECT_EQ(motion[0].moved_s, 0);
  for (std::size_t i = 1; i < 30; ++i) {
    EXPECT_FALSE(motion[i].learned);
    EXPECT_NEAR(motion[i].moved_s, 1.0 / 30, 1e-12);
  }
  EXPECT_TRUE(motion.back().learned);
}

TEST(MotionFollower, MovesOneSecondASecondAtMeanSpeed) {
  const auto motion = follow(places(0, std::vector<double>(300, 1.0)));
  // The texture is not equally rough everywhere, so single seconds differ; nine of them by little.
  EXPECT_NEAR(moved_s(motion, 31, 301), 9, 0.9);
}

TEST(MotionFollower, MovesTwiceAsFarAtTwiceTheSpeed) {
  std::vector<double> speeds;
  for (int i = 0; i < 600; ++i) speeds.push_back(i / 60 % 2 == 0 ? 0.7 : 1.4);  // every two seconds
  const auto motion = follow(places(0, speeds));
  double slow = 0, fast = 0;
  for (std::size_t i = 240; i < 600; ++i) {
    if (i % 60 < 12) continue;  // spans reach over the change
    (i / 60 % 2 == 0 ? slow : fast) += motion[i].moved_s;
  }
  // Short spans of alignment error are not in proportion to speed; the order and the rough size are.
  EXPECT_GT(fast, 1.5 * slow);
  EXPECT_LT(fast, 2.5 * slow);
}

TEST(MotionFollower, NoticesAStandAfterItsSpan) {
  std::vector<double> speeds(240, 1.0);
  speeds.insert(speeds.end(), 120, 0.0);
  speeds.insert(speeds.end(), 60, 1.0);
  const auto motion = follow(places(0, speeds));
  for (std::size_t i = 0; i < 240; ++i) EXPECT_FALSE(motion[i].standing) << i;
  for (std::size_t i = 240 + 62; i < 360; ++i) {
    EXPECT_TRUE(motion[i].standing) << i;
    EXPECT_EQ(motion[i].moved_s, 0);
    EXPECT_EQ(motion[i].variance_s2, 0);
  }
  EXPECT_FALSE(motion.back().standing);
}

/// Whether the last of 100 frames at 25 Hz is taken for one of a pause. The view turns from one picture of
/// normal pixels towards another: an angle d apart, its alignment error is 2 sqrt(2 / pi) sin(d / 2).
template <typename Angle>
bool stands_at_last(Angle angle_rad) {
  constexpr std::size_t kPixels = 2048;
  vo::Rng rng(4);
  std::vector<double> a(kPixels), b(kPixels);
  for (double& x : a) x = rng.normal();
  for (double& x : b) x = rng.normal();
  vo::MotionFollower follower;
  vo::FollowedMotion motion;
  for (int i = 0; i < 100; ++i) {
    const double angle = angle_rad(i);
    std::vector<std::uint8_t> picture(kPixels);
    for (std::size_t k = 0; k < kPixels; ++k) {
      const double x = std::cos(angle) * a[k] + std::sin(angle) * b[k];
      picture[k] = static_cast<std::uint8_t>(std::clamp(std::lround(128 + 16 * x), 0L, 255L));
    }
    motion = follower.push(picture, i / 25.0);
  }
  return motion.standing;
}

TEST(MotionFollower, DoesNotTakeASlowWalkForAPause) {
  // Of unrelated pictures, whose error is taken to be 0.8 until some were seen: half in 2 s, which is 50
  // frames, and a quarter to and fro.
  const auto angle_of = [](double error) {
    return 2 * std::asin(error / (2 * std::sqrt(2 / std::numbers::pi)));
  };
  EXPECT_FALSE(stands_at_last([&](int i) { return angle_of(0.4) * i / 50; }));
  EXPECT_TRUE(
      stands_at_last([&](int i) { return angle_of(0.2) / 2 * std::sin(2 * std::numbers::pi * i / 33); }));
}

TEST(MotionFollower, DependsOnNoLaterFrame) {
  const auto place_px = places(0, std::vector<double>(200, 0.8));
  const auto all = follow(place_px);
  const auto some = follow({place_px.begin(), place_px.begin() + 100});
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(all[i].moved_s, some[i].moved_s);
}

TEST(MotionFollower, GoesOnAtMeanSpeedWhereNothingIsSeen) {
  const vo::Walk walk = Wall(2000, 1).walk(places(0, std::vector<double>(150, 1.0)));
  const vo::ImageStack normalised = vo::patch_normalise(walk.thumbnails, {});
  const std::vector<std::uint8_t> black(normalised.image_size(), vo::kNeutralByte);
  vo::MotionFollower follower;
  double variance_seen = 0;
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    const bool seen = i < 100;
    const auto motion =
        follower.push(seen ? normalised[i] : std::span<const std::uint8_t>(black), walk.time_s[i], seen);
    if (i == 99) variance_seen = motion.variance_s2;
    if (seen) continue;
    EXPECT_NEAR(motion.moved_s, 1.0 / 30, 1e-9);
    EXPECT_GT(motion.variance_s2, variance_seen);
    EXPECT_FALSE(motion.standing);
  }
}

TEST(MotionFollower, RefusesWhatIsNoWalk) {
  const std::vector<std::uint8_t> picture(2048, vo::kNeutralByte), other(100, vo::kNeutralByte);
  vo::MotionFollower follower;
  follower.push(picture, 1);
  EXPECT_THROW(follower.push(picture, 1), std::invalid_argument);
  EXPECT_THROW(follower.push(other, 2), std::invalid_argument);
  EXPECT_THROW(vo::MotionFollower({.spans = 3, .separations = 4}), std::invalid_argument);
  EXPECT_THROW(vo::MotionFollower({.memory_s = 0}), std::invalid_argument);
}

TEST(MotionFollower, SaysNothingOfPicturesThatNeverChange) {
  const std::vector<std::uint8_t> picture(2048, vo::kNeutralByte);
  vo::MotionFollower follower;
  double moved = 0;
  for (int i = 0; i < 300; ++i) moved += follower.push(picture, i / 30.0).moved_s;
  EXPECT_LE(moved, 2.2);  // of the span before the stand is noticed
}

TEST(MotionFollower, GoesOnAfterAPauseOfTheRecording) {
  const vo::Walk walk = Wall(2000, 1).walk(places(0, std::vector<double>(600, 1.0)));
  const vo::ImageStack normalised = vo::patch_normalise(walk.thumbnails, {});
  vo::MotionFollower follower;
  for (std::size_t i = 0; i < walk.frames(); ++i) {
    const auto motion = follower.push(normalised[i], walk.time_s[i] + (i >= 300 ? 600 : 0));
    EXPECT_TRUE(i <= 310 || motion.learned) << i;
  }
}

}  // namespace
