#include <cmath>
#include <optional>
#include <support/known_motion.hpp>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/motion/segment_tie.hpp>

namespace {

using test_support::known_motion;
using test_support::KnownMotion;
using Displacements = std::vector<std::optional<double>>;

constexpr std::size_t kLost = 500, kFound = 560;  // frames of a walk of 25 frames/s: 2.4 s

/// A walk that is lost once: what is tied before, and the way after it in units of 4 m.
struct LostOnce {
  KnownMotion walk;
  Displacements tied, way;

  explicit LostOnce(const KnownMotion& motion) : walk(motion), tied(motion.frames()), way(motion.frames()) {
    for (std::size_t i = 1; i < kLost; ++i) tied[i] = motion.metres[i];
    for (std::size_t i = kFound; i < motion.frames(); ++i) way[i] = motion.metres[i] / 4;
  }
  [[nodiscard]] vo::FrameRange run() const { return {kFound, walk.frames()}; }
};

TEST(TieBySpeed, TakesTheSpeedBeforeTheLoss) {
  const LostOnce lost(known_motion(60, 1.4, 1.4));
  const auto tie = vo::tie_by_speed(lost.walk.time_s, lost.run(), lost.way, lost.tied);
  ASSERT_TRUE(tie);
  EXPECT_NEAR(tie->scale, 4, 1e-6);  // rounding
  EXPECT_EQ(tie->sigma, 0.05);       // it never changed, but may begin to
}

TEST(TieBySpeed, IsAsUnsureAsSpeedVariesOverTheLoss) {
  const LostOnce lost(known_motion(60, 0.7, 2.1));
  const auto tie = vo::tie_by_speed(lost.walk.time_s, lost.run(), lost.way, lost.tied);
  ASSERT_TRUE(tie);
  // Speed swings between 0.7 and 2.1 m/s in 9 s. Over the 3.4 s from the second before to the second after,
  // its logarithm swings by 2 sin(pi 3.4 / 9) times its own deviation, which is 0.38 for a ratio of 1 to 3.
  EXPECT_NEAR(tie->sigma, 0.7, 0.1);
  EXPECT_LT(std::abs(std::log(tie->scale / 4)), 2 * tie->sigma);
}

TEST(TieBySpeed, IsUsualWhereTheWalkIsTooShortToTell) {
  LostOnce lost(known_motion(60, 1.4, 1.4));
  for (std::size_t i = 0; i < kLost - 50; ++i) lost.tied[i].reset();  // two seconds are left
  const auto tie = vo::tie_by_speed(lost.walk.time_s, lost.run(), lost.way, lost.tied);
  ASSERT_TRUE(tie);
  EXPECT_EQ(tie->sigma, vo::SegmentTieOptions{}.usual_speed_sigma);
}

TEST(TieBySpeed, SaysNothingOfAWalkThatStandsOrIsNotTied) {
  LostOnce lost(known_motion(60, 1.4, 1.4));
  const Displacements none(lost.walk.frames());
  EXPECT_FALSE(vo::tie_by_speed(lost.walk.time_s, lost.run(), lost.way, none));
  for (std::size_t i = kFound; i < kFound + 30; ++i) lost.way[i] = 0;
  EXPECT_FALSE(vo::tie_by_speed(lost.walk.time_s, lost.run(), lost.way, lost.tied));
}

TEST(TieBySpeed, SaysNothingWhereLittleOfTheSecondIsKnown) {
  LostOnce lost(known_motion(60, 1.4, 1.4));
  for (std::size_t i = kLost - 25; i < kLost - 5; ++i) lost.tied[i].reset();
  EXPECT_FALSE(vo::tie_by_speed(lost.walk.time_s, lost.run(), lost.way, lost.tied));
}

TEST(TieByRelation, ReadsAlignmentErrorOnBothSides) {
  LostOnce lost(known_motion(60, 1, 1.8));
  const auto tie = vo::tie_by_relation(lost.walk.evidence(), lost.run(), lost.way, lost.tied);
  ASSERT_TRUE(tie);
  // Exact but for the bins the relation is averaged in and the least over five separations.
  EXPECT_NEAR(tie->scale, 4, 0.03 * 4);
  EXPECT_EQ(tie->sigma, vo::SegmentTieOptions{}.relation_sigma);
  vo::MotionEvidence without = lost.walk.evidence();
  without.errors = nullptr;
  EXPECT_FALSE(vo::tie_by_relation(without, lost.run(), lost.way, lost.tied));
  const Displacements none(lost.walk.frames());
  EXPECT_FALSE(vo::tie_by_relation(lost.walk.evidence(), lost.run(), lost.way, none));
}

TEST(TieByRelation, GoesFurtherBackThanALongLoss) {
  LostOnce lost(known_motion(60, 1, 1.8));
  for (std::size_t i = 250; i < kLost; ++i) lost.tied[i].reset();  // in all 12 s, and it is read over 9
  const auto tie =
      vo::tie_by_relation(lost.walk.evidence(), lost.run(), lost.way, lost.tied, {.relation_window_s = 9});
  ASSERT_TRUE(tie);
  EXPECT_NEAR(tie->scale, 4, 0.03 * 4);
}

TEST(TieByRelation, IsNotReadInATurn) {
  LostOnce lost(known_motion(60, 1, 1.8));
  // For four of the ten seconds it turns by half a radian a second, and the picture changes three times as
  // much.
  for (std::size_t i = kFound; i < kFound + 100; ++i) {
    lost.walk.track.frames[i].turn_rad = i % 2 == 0 ? 0.02 : -0.02;
    for (auto& errors : lost.walk.errors.by_span) errors[i].error *= 3;
  }
  const auto tie = vo::tie_by_relation(lost.walk.evidence(), lost.run(), lost.way, lost.tied);
  ASSERT_TRUE(tie);
  // The last frames before the turn ends and the first after are compared with those in it.
  EXPECT_NEAR(tie->scale, 4, 0.05 * 4);
}

TEST(CombinedTie, WeighsByInverseVariance) {
  // Logarithms 0 and 1, weights 1 / 0.04 and 1 / 0.16: a fifth of the way from the surer one.
  const auto both = vo::combined(vo::SegmentTie{1, 0.2}, vo::SegmentTie{std::exp(1), 0.4});
  ASSERT_TRUE(both);
  EXPECT_NEAR(both->scale, std::exp(0.2), 1e-12);
  EXPECT_NEAR(both->sigma, 0.4 / std::sqrt(5), 1e-12);
  EXPECT_EQ(vo::combined(std::nullopt, vo::SegmentTie{3, 0.4})->scale, 3);
  EXPECT_EQ(vo::combined(vo::SegmentTie{3, 0.4}, std::nullopt)->scale, 3);
  EXPECT_FALSE(vo::combined(std::nullopt, std::nullopt));
}

}  // namespace
