#include "sweep_axes.hpp"

#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using retrace::SweepOptions;
using retrace::swept_axes;
using testing::ElementsAre;

TEST(SweepAxes, AreMotionLengthAndRangeAndThoseOfVary) {
  SweepOptions options;
  options.vary = {"enhance=local,standardise"};
  const auto axes = swept_axes(options);
  ASSERT_EQ(axes.size(), 4U);
  EXPECT_EQ(axes[0].setting, "motion");
  EXPECT_THAT(axes[0].values, ElementsAre("sad", "none"));
  EXPECT_EQ(axes[1].setting, "sequence-length");
  EXPECT_THAT(axes[1].values, ElementsAre("5", "10", "20", "40"));
  EXPECT_EQ(axes[2].setting, "search-range-rad");
  EXPECT_EQ(axes[3].setting, "enhance");
  EXPECT_THAT(axes[3].values, ElementsAre("local", "standardise"));
}

TEST(SweepAxes, LengthsAreKeyframesOrMetres) {
  SweepOptions options;
  options.lengths_m = {"10", "20"};
  EXPECT_EQ(swept_axes(options)[1].setting, "sequence-length-m");
  EXPECT_THAT(swept_axes(options)[1].values, ElementsAre("10", "20"));
  options.lengths = {"5"};
  EXPECT_THROW_WITH(swept_axes(options), vo::Error, "--sequence-length-m: is given beside --sequence-length");
}

TEST(SweepAxes, NoSettingVariesTwice) {
  SweepOptions options;
  options.vary = {"enhance=local", "enhance=standardise"};
  EXPECT_THROW_WITH(swept_axes(options), vo::Error, "one list of enhance");
  options.vary = {"motion=steps"};
  EXPECT_THROW_WITH(swept_axes(options), vo::Error, "--vary motion=steps: varies a setting twice");
}

}  // namespace
