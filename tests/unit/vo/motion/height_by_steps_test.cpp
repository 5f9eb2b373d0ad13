#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/motion/height_by_steps.hpp>

namespace {

/// Twenty frames of 0.5 units each, in which the ground is seen 2 units below.
vo::DisplacementTrack level_track() {
  vo::DisplacementTrack track;
  for (int i = 0; i < 20; ++i) {
    track.frames.push_back({.valid = true, .displacement = 0.5});
    track.heights.push_back({2});
  }
  return track;
}

TEST(HeightBySteps, IsTheGroundsInMetres) {
  // 0.4 m to half a unit: a unit is 0.8 m, and the camera 1.6 m high.
  const auto height_m = vo::height_by_steps_m(level_track(), std::vector<double>(20, 0.4));
  ASSERT_TRUE(height_m);
  EXPECT_NEAR(*height_m, 1.6, 0.02);  // the peak is looked for in steps far below its spread of 0.05
}

TEST(HeightBySteps, IsThatOfTheSegmentInWhichMostWasWalked) {
  vo::DisplacementTrack track = level_track();
  for (int i = 0; i < 10; ++i) {
    track.frames.push_back({.valid = true, .displacement = 5, .segment = 1});
    track.heights.push_back({30});
  }
  for (int i = 0; i < 10; ++i) {  // lost frames say nothing
    track.frames.push_back({.valid = false, .displacement = 9});
    track.heights.push_back({9});
  }
  const auto height_m = vo::height_by_steps_m(track, std::vector<double>(40, 0.4));
  ASSERT_TRUE(height_m);
  EXPECT_NEAR(*height_m, 1.6, 0.02);
}

TEST(HeightBySteps, IsNoneWithoutStepsOrGround) {
  EXPECT_FALSE(vo::height_by_steps_m({}, {}));
  EXPECT_FALSE(vo::height_by_steps_m(level_track(), std::vector<double>(20, 0)));
  vo::DisplacementTrack track = level_track();
  track.heights.assign(20, {});
  EXPECT_FALSE(vo::height_by_steps_m(track, std::vector<double>(20, 0.4)));
  track.heights.clear();
  EXPECT_FALSE(vo::height_by_steps_m(track, std::vector<double>(20, 0.4)));
  EXPECT_THROW(vo::height_by_steps_m(track, std::vector<double>(3, 0.4)), std::invalid_argument);
}

}  // namespace
