#include "io/recording_tags.hpp"

#include <gtest/gtest.h>

namespace {

TEST(RecordingTags, TrueTimeByPlayingTime) {
  EXPECT_DOUBLE_EQ(vo::time_scale(30, 240), 1 / 8.0);
  EXPECT_DOUBLE_EQ(vo::time_scale(29.7, 240), 1 / 8.0);  // frames were dropped
  EXPECT_DOUBLE_EQ(vo::time_scale(30, 1), 30);
  EXPECT_DOUBLE_EQ(vo::time_scale(25, 60), 25 / 60.0);  // no whole ratio
  EXPECT_DOUBLE_EQ(vo::time_scale(30, 30), 1);
}

}  // namespace
