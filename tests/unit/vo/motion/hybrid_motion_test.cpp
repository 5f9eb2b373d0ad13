#include <cmath>
#include <numeric>
#include <stdexcept>
#include <support/known_motion.hpp>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/motion/hybrid_motion.hpp>

namespace {

using test_support::known_motion;
using test_support::KnownMotion;
using vo::DisplacementSource;

vo::HybridMotionOptions unsmoothed() {
  vo::HybridMotionOptions options;
  options.scale.smoothing_s = 0;
  options.scale.tie.relation_sigma = 0.001;  // these walks have one scene
  return options;
}

double length(const vo::HybridMotion& motion, std::size_t begin, std::size_t end) {
  double total = 0;
  for (std::size_t i = begin; i < end; ++i) total += motion.frames[i].value;
  return total;
}

TEST(HybridMotion, PutsAlignmentErrorWhereTheTrackIsLost) {
  KnownMotion walk = known_motion(60, 0.8, 1.8);
  walk.lose(600, 725, 3);
  const vo::HybridMotion motion = vo::hybrid_motion(walk.evidence(), unsmoothed());
  EXPECT_FALSE(motion.metric);
  EXPECT_EQ(motion.frames[0].source, DisplacementSource::kNone);
  for (std::size_t i = 1; i < walk.frames(); ++i) {
    const bool lost = i >= 600 && i < 725;
    ASSERT_EQ(motion.frames[i].source,
              lost ? DisplacementSource::kAlignmentError : DisplacementSource::kTrack)
        << i;
    // The relation is exact but for the bins it is learned in and the least over five frames.
    EXPECT_NEAR(motion.frames[i].value, walk.metres[i], 0.12 * walk.metres[i]) << i;
  }
  EXPECT_NEAR(length(motion, 0, walk.frames()), std::accumulate(walk.metres.begin(), walk.metres.end(), 0.0),
              1.5);
}

TEST(HybridMotion, PutsStepsThereWhereTheyAreTheBetter) {
  KnownMotion walk = known_motion(60, 0.8, 1.8);
  walk.lose(600, 725, 3);
  vo::Rng rng(3);
  for (auto& errors : walk.errors.by_span)
    for (vo::Comparison& compared : errors) compared.error *= static_cast<float>(rng.uniform(0.3, 1.7));
  vo::MotionEvidence evidence = walk.evidence();
  evidence.steps_m = walk.metres;
  evidence.steps_known.assign(walk.frames(), true);
  const vo::HybridMotion motion = vo::hybrid_motion(evidence, unsmoothed());
  EXPECT_TRUE(motion.metric);
  for (std::size_t i = 600; i < 725; ++i) {
    EXPECT_EQ(motion.frames[i].source, DisplacementSource::kSteps);
    EXPECT_EQ(motion.frames[i].value, walk.metres[i]);
  }
  EXPECT_EQ(motion.frames[300].source, DisplacementSource::kTrack);
}

TEST(HybridMotion, HoldsTheSpeedWhereNothingIsSeen) {
  KnownMotion walk = known_motion(40, 1, 1);
  for (std::size_t i = 500; i < walk.frames(); ++i) walk.metres[i] *= 2;
  walk.lose(450, 550, 1);
  vo::MotionEvidence evidence = walk.evidence();
  for (std::size_t i = 450; i < 550; ++i) evidence.errors_known[i] = false;
  const vo::HybridMotion motion = vo::hybrid_motion(evidence, unsmoothed());
  // The unit after the loss is that of the alignment errors, which know of no change of speed.
  const double before = motion.frames[449].value, after = motion.frames[550].value;
  for (std::size_t i = 450; i < 550; ++i) {
    EXPECT_EQ(motion.frames[i].source, DisplacementSource::kHeld);
    const double share = (static_cast<double>(i) - 450 + 0.5) / 100;
    EXPECT_NEAR(motion.frames[i].value, before + share * (after - before), 0.05 * before) << i;
  }
}

/// A walk in metres at 32 frames/s (whose times are exact) that is lost for three seconds after twelve: a
/// metre a second before, two after. Its steps are known but for the loss.
struct LostBetweenTwoSpeeds {
  static constexpr std::size_t kFrames = 865, kLost = 385, kFoundAgain = 481;
  LostBetweenTwoSpeeds() {
    for (std::size_t i = 0; i < kFrames; ++i) {
      evidence.time_s.push_back(static_cast<double>(i) / 32);
      evidence.steps_m.push_back(i == 0 ? 0 : (i < kFoundAgain ? 1.0 : 2.0) / 32);
      const bool seen = i > 0 && (i < kLost || i >= kFoundAgain);
      evidence.steps_known.push_back(i < kLost || i >= kFoundAgain);
      track.frames.push_back(
          {.valid = seen, .displacement = evidence.steps_m[i], .segment = i < kFoundAgain ? 0 : 1});
    }
    evidence.track = &track;
  }
  vo::DisplacementTrack track;
  vo::MotionEvidence evidence;
};

TEST(HybridMotion, HoldsASpeedBetweenTheOneBeforeAndTheOneAfter) {
  LostBetweenTwoSpeeds walk;
  // The last frame before the loss was a leap: it counts as one of a second's.
  constexpr double kLeap = 1.5;
  walk.track.frames[walk.kLost - 1].displacement *= kLeap;
  const vo::HybridMotion motion = vo::hybrid_motion(walk.evidence, unsmoothed());
  EXPECT_TRUE(motion.metric);
  const double before = (31 + kLeap) / 32, after = 2;
  for (std::size_t i = walk.kLost; i < walk.kFoundAgain; ++i) {
    ASSERT_EQ(motion.frames[i].source, DisplacementSource::kHeld);
    const double share = (static_cast<double>(i - walk.kLost) + 0.5) / (walk.kFoundAgain - walk.kLost);
    // The track's unit comes of steps that know of no leap, so that it is 0.1 % off.
    EXPECT_NEAR(motion.frames[i].value * 32, std::lerp(before, after, share), 0.003) << i;
    // Speeds of one and of two, half of the time each: a third of their mean.
    EXPECT_NEAR(motion.frames[i].sigma / motion.frames[i].value, 1.0 / 3, 0.02) << i;
  }
}

TEST(HybridMotion, MeasuresTheErrorOfStepsOverSeconds) {
  LostBetweenTwoSpeeds walk;
  // A fifth too long in one second, a fifth too short in the next.
  for (std::size_t i = 1; i < walk.kFrames; ++i) {
    walk.evidence.steps_m[i] = (1 + ((i - 1) / 32 % 2 == 0 ? 0.2 : -0.2)) / 32;
    walk.track.frames[i].displacement = 1.0 / 32;
  }
  walk.evidence.steps_known.assign(walk.kFrames, true);
  const vo::HybridMotion motion = vo::hybrid_motion(walk.evidence, unsmoothed());
  for (std::size_t i = walk.kLost; i < walk.kFoundAgain; ++i) {
    ASSERT_EQ(motion.frames[i].source, DisplacementSource::kSteps);
    EXPECT_NEAR(motion.frames[i].sigma / motion.frames[i].value, 0.2, 0.02);
  }
  // Four seconds beside the track are too few to tell.
  for (std::size_t i = 5 * 32; i < walk.kFrames; ++i) walk.track.frames[i].valid = false;
  const vo::HybridMotion hardly = vo::hybrid_motion(walk.evidence, unsmoothed());
  EXPECT_EQ(hardly.frames[450].sigma, vo::kUsualStepsError * hardly.frames[450].value);
}

TEST(HybridMotion, LearnsWhatErrorsMeanNearTheLoss) {
  // Another scene from the middle on, in which errors are twice as large.
  KnownMotion walk = known_motion(160, 0.8, 1.8);
  constexpr std::size_t kOther = 2000;
  for (auto& errors : walk.errors.by_span)
    for (std::size_t i = kOther; i < errors.size(); ++i) errors[i].error *= 2;
  walk.lose(1000, 1100, 1);
  walk.lose(3000, 3100, 1);
  const vo::HybridMotion motion = vo::hybrid_motion(walk.evidence(), unsmoothed());
  for (const std::size_t begin : {1000, 3000}) {
    EXPECT_EQ(motion.frames[begin].source, DisplacementSource::kAlignmentError);
    EXPECT_NEAR(length(motion, begin, begin + 100), test_support::sum(walk.metres, begin, begin + 100),
                0.1 * test_support::sum(walk.metres, begin, begin + 100));
  }
}

TEST(HybridMotion, LearnsFromAllWhereTooLittleIsNear) {
  KnownMotion walk = known_motion(60, 0.8, 1.8);
  walk.lose(600, 725, 1);
  vo::HybridMotionOptions options = unsmoothed();
  options.window_s = 0.1;
  const vo::HybridMotion motion = vo::hybrid_motion(walk.evidence(), options);
  for (std::size_t i = 600; i < 725; ++i) {
    ASSERT_EQ(motion.frames[i].source, DisplacementSource::kAlignmentError);
    EXPECT_NEAR(motion.frames[i].value, walk.metres[i], 0.12 * walk.metres[i]) << i;
  }
}

TEST(HybridMotion, StandsWhereTheViewDoesNotChange) {
  KnownMotion walk = known_motion(40, 1, 1.5);
  walk.lose(300, 400, 1);
  vo::MotionEvidence evidence = walk.evidence();
  evidence.standing.assign(walk.frames(), false);
  for (std::size_t i = 320; i < 360; ++i) evidence.standing[i] = true;
  for (std::size_t i = 370; i < 390; ++i) {
    evidence.standing[i] = true;  // but nothing is seen: no view that changed or did not
    evidence.errors_known[i] = false;
  }
  const vo::HybridMotion motion = vo::hybrid_motion(evidence, unsmoothed());
  EXPECT_EQ(motion.frames[340].value, 0);
  EXPECT_GT(motion.frames[310].value, 0);
  EXPECT_GT(motion.frames[380].value, 0);
  EXPECT_EQ(motion.frames[380].source, DisplacementSource::kHeld);
}

TEST(HybridMotion, WithoutATrackIsSteps) {
  const KnownMotion walk = known_motion(20, 1, 1.5);
  const vo::MotionEvidence evidence{
      .time_s = walk.time_s, .steps_m = walk.metres, .steps_known = std::vector<bool>(walk.frames(), true)};
  const vo::HybridMotion motion = vo::hybrid_motion(evidence);
  EXPECT_TRUE(motion.metric);
  for (std::size_t i = 1; i < walk.frames(); ++i) EXPECT_EQ(motion.frames[i].value, walk.metres[i]);
}

TEST(HybridMotion, WithAlignmentErrorAloneIsInSecondsAtMeanSpeed) {
  const KnownMotion walk = known_motion(40, 0.8, 1.8);
  const vo::MotionEvidence evidence{
      .time_s = walk.time_s, .errors = &walk.errors, .errors_known = std::vector<bool>(walk.frames(), true)};
  const vo::HybridMotion motion = vo::hybrid_motion(evidence);
  EXPECT_FALSE(motion.metric);
  // It is learned over time, so that the mean is a second a second; a bent relation adds a little.
  EXPECT_NEAR(length(motion, 0, walk.frames()) / walk.time_s.back(), 1, 0.05);
}

TEST(HybridMotion, WalksOnOverAShortJumpOfTheClockAndStopsAtALongOne) {
  KnownMotion walk = known_motion(40, 1, 1);
  for (const double jump_s : {2.0, 600.0}) {
    vo::MotionEvidence evidence = walk.evidence();
    for (std::size_t i = 500; i < walk.frames(); ++i) evidence.time_s[i] += jump_s;
    vo::DisplacementTrack track = walk.track;
    track.frames[500].valid = false;
    evidence.track = &track;
    evidence.errors_known[500] = false;
    const vo::HybridMotion motion = vo::hybrid_motion(evidence, unsmoothed());
    EXPECT_EQ(motion.frames[500].source, DisplacementSource::kHeld);
    // A metre a second on both sides, and the 1/25 s that lay between the two frames before.
    EXPECT_NEAR(motion.frames[500].value, jump_s < 3 ? jump_s + 0.04 : 0, 1e-6);
    EXPECT_NEAR(motion.frames[501].value, 0.04, 1e-6);
  }
}

TEST(HybridMotion, TrustsNoSourceMoreThanItDeserves) {
  KnownMotion walk = known_motion(60, 0.8, 1.8);
  walk.lose(600, 725, 3);
  const vo::HybridMotion exact = vo::hybrid_motion(walk.evidence(), unsmoothed());
  vo::Rng rng(3);
  for (auto& errors : walk.errors.by_span)
    for (vo::Comparison& compared : errors) compared.error *= static_cast<float>(rng.uniform(0.3, 1.7));
  const vo::HybridMotion noisy = vo::hybrid_motion(walk.evidence(), unsmoothed());
  EXPECT_LT(exact.frames[650].sigma, 0.1 * exact.frames[650].value);
  EXPECT_GT(noisy.frames[650].sigma / noisy.frames[650].value,
            1.5 * exact.frames[650].sigma / exact.frames[650].value);
}

TEST(HybridMotion, RefusesWhatDoesNotFit) {
  const KnownMotion walk = known_motion(10, 1, 1.5);
  vo::MotionEvidence evidence = walk.evidence();
  evidence.errors_known.pop_back();
  EXPECT_THROW(vo::hybrid_motion(evidence), std::invalid_argument);
  EXPECT_THROW(vo::hybrid_motion({.time_s = {0}}), std::invalid_argument);
  EXPECT_THROW(vo::hybrid_motion({}), std::invalid_argument);
  EXPECT_EQ(vo::hybrid_motion({.time_s = {0, 1}}).frames[1].value, 0);  // nothing said, nothing moved
}

}  // namespace
