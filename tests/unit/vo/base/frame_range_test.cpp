#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/frame_range.hpp>

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FramesAround, TakesWhatIsInReachOnBothSides) {
  const std::vector<double> time_s{0, 1, 2, 3, 4, 5, 6};
  EXPECT_EQ(vo::frames_around(time_s, {3, 4}, 0), (vo::FrameRange{3, 4}));
  EXPECT_EQ(vo::frames_around(time_s, {3, 4}, 1), (vo::FrameRange{2, 5}));
  EXPECT_EQ(vo::frames_around(time_s, {2, 5}, 1.5), (vo::FrameRange{1, 6}));
  EXPECT_EQ(vo::frames_around(time_s, {0, 7}, 9), (vo::FrameRange{0, 7}));
}

TEST(FramesAround, RefusesWhatIsNoRange) {
  const std::vector<double> time_s{0, 1, 2};
  EXPECT_THROW(vo::frames_around(time_s, {1, 1}, 1), std::invalid_argument);
  EXPECT_THROW(vo::frames_around(time_s, {1, 4}, 1), std::invalid_argument);
  EXPECT_THROW(vo::frames_around({}, {0, 1}, 1), std::invalid_argument);
}

TEST(MarkedRanges, AreTheLongest) {
  EXPECT_THAT(vo::marked_ranges({true, true, false, true, false, false, true}),
              ElementsAre(vo::FrameRange{0, 2}, vo::FrameRange{3, 4}, vo::FrameRange{6, 7}));
  EXPECT_THAT(vo::marked_ranges({}), IsEmpty());
  EXPECT_THAT(vo::marked_ranges({false, false}), IsEmpty());
  EXPECT_THAT(vo::marked_ranges({true}), ElementsAre(vo::FrameRange{0, 1}));
}

}  // namespace
