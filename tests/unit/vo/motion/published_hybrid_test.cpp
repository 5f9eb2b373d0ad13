#include <stdexcept>
#include <support/made_errors.hpp>
#include <vector>

#include <gtest/gtest.h>

#include <vo/motion/published_hybrid.hpp>

namespace {

using vo::DisplacementSource;

/// 25 frames a second; the error of two frames is half of the way between them, up to 4 frames apart.
struct Walk {
  explicit Walk(std::vector<double> metres_a_frame) : metres(std::move(metres_a_frame)) {
    std::vector<double> at{0};
    for (std::size_t i = 1; i < metres.size(); ++i) at.push_back(at.back() + metres[i]);
    errors = test_support::made_errors(metres.size(), 25, 4,
                                       [&](std::size_t i, std::size_t j) { return (at[j] - at[i]) / 2; });
    for (std::size_t i = 0; i < metres.size(); ++i) {
      track.frames.push_back({.valid = i > 0, .displacement = metres[i], .sigma = 0});
      evidence.time_s.push_back(static_cast<double>(i) / 25);
    }
    evidence.errors_known.assign(metres.size(), true);
  }

  [[nodiscard]] std::vector<vo::FrameDisplacement> hybrid() {
    evidence.track = &track;
    evidence.errors = &errors;
    return vo::hybrid_as_published(evidence);
  }

  std::vector<double> metres;
  vo::AlignmentErrors errors;
  vo::DisplacementTrack track;
  vo::MotionEvidence evidence;
};

/// Speeds of 1 to 3 by turns, so that there is a relation to learn.
std::vector<double> speeds(std::size_t frames) {
  std::vector<double> metres;
  for (std::size_t i = 0; i < frames; ++i) metres.push_back(1 + static_cast<double>(i % 5) / 2);
  return metres;
}

TEST(HybridAsPublished, FillsALossByWhatTheErrorMeantBeforeIt) {
  Walk walk(speeds(300));
  for (std::size_t i = 200; i < 300; ++i) {
    walk.track.frames[i].valid = false;
    walk.track.frames[i].displacement = 0;
  }
  const auto frames = walk.hybrid();
  EXPECT_EQ(frames[0].source, DisplacementSource::kNone);
  for (std::size_t i = 1; i < 200; ++i) {
    EXPECT_EQ(frames[i].source, DisplacementSource::kTrack);
    EXPECT_EQ(frames[i].value, walk.metres[i]);
  }
  for (std::size_t i = 200; i < 300; ++i) {
    EXPECT_EQ(frames[i].source, DisplacementSource::kAlignmentError);
    // The relation is straight, and twelfths of the pairs averaged lie on it.
    EXPECT_NEAR(frames[i].value, walk.metres[i], 0.02 * walk.metres[i]) << i;
  }
}

TEST(HybridAsPublished, LearnsNothingFromWhatIsToCome) {
  Walk walk(speeds(400));
  for (std::size_t i = 200; i < 250; ++i) walk.track.frames[i].valid = false;
  const auto before = walk.hybrid();
  for (std::size_t i = 250; i < 400; ++i) walk.track.frames[i].displacement *= 7;
  const auto after = walk.hybrid();
  for (std::size_t i = 0; i < 250; ++i) EXPECT_EQ(before[i].value, after[i].value);
}

TEST(HybridAsPublished, LeavesTheJumpOfScaleOfANewSegment) {
  // The second segment has a third of the first one's unit; what is lost after it is learned from it alone.
  Walk walk(speeds(600));
  for (std::size_t i = 0; i < 600; ++i) {
    vo::TrackedDisplacement& frame = walk.track.frames[i];
    frame.valid = i > 0 && !(i >= 200 && i < 250) && i < 500;
    frame.segment = i < 250 ? 0 : 1;
    if (frame.segment == 1) frame.displacement *= 3;
  }
  const auto frames = walk.hybrid();
  EXPECT_NEAR(frames[225].value, walk.metres[225], 0.02 * walk.metres[225]);
  EXPECT_EQ(frames[300].value, 3 * walk.metres[300]);
  EXPECT_NEAR(frames[550].value, 3 * walk.metres[550], 0.06 * walk.metres[550]);
}

TEST(HybridAsPublished, KnowsNothingBeforeItHasLearned) {
  Walk walk(speeds(100));
  for (vo::TrackedDisplacement& frame : walk.track.frames) frame.valid = false;
  for (const vo::FrameDisplacement& frame : walk.hybrid()) {
    EXPECT_EQ(frame.value, 0);
    EXPECT_EQ(frame.source, DisplacementSource::kNone);
  }
  EXPECT_THROW(vo::hybrid_as_published({.time_s = {0, 1}}), std::invalid_argument);
  vo::DisplacementTrack one;
  one.frames.resize(1);
  EXPECT_EQ(vo::hybrid_as_published({.time_s = {0}, .track = &one}).size(), 1U);
}

}  // namespace
