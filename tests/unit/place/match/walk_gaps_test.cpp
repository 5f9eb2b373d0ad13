#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/walk_gaps.hpp>

namespace {

using place::Stretch;
using place::stretches_between;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(StretchesBetween, CutsAWalkBeforeEachGap) {
  EXPECT_THAT(stretches_between({3, 4}, 10), ElementsAre(Stretch{0, 3}, Stretch{3, 4}, Stretch{4, 10}));
}

TEST(StretchesBetween, LeavesAWalkWithoutGapsWhole) {
  EXPECT_THAT(stretches_between({}, 10), ElementsAre(Stretch{0, 10}));
  EXPECT_THAT(stretches_between({}, 1), ElementsAre(Stretch{0, 1}));
  EXPECT_THAT(stretches_between({}, 0), IsEmpty());
}

TEST(StretchesBetween, PassesOverGapsOutsideTheWalk) {
  EXPECT_THAT(stretches_between({0, 5, 10, 12}, 10), ElementsAre(Stretch{0, 5}, Stretch{5, 10}));
}

TEST(StretchesBetween, RefusesGapsOutOfOrder) {
  EXPECT_THROW(stretches_between({4, 3}, 10), std::invalid_argument);
  EXPECT_THROW(stretches_between({4, 4}, 10), std::invalid_argument);
}

// A frame a second, and a jump of ten seconds before frame 4, of two before frame 8.
const std::vector<double> kTimes{0, 1, 2, 3, 13, 14, 15, 16, 18, 19};

TEST(GapsAt, AreBeforeTheFirstKeyframeAfterALongJump) {
  EXPECT_THAT(place::gaps_at(std::vector<std::size_t>{0, 2, 4, 6, 8}, kTimes), ElementsAre(2));
  EXPECT_THAT(place::gaps_at(std::vector<std::size_t>{0, 3, 7}, kTimes), ElementsAre(2));
}

TEST(GapsAt, ThatPartNoKeyframesAreNone) {
  EXPECT_THAT(place::gaps_at(std::vector<std::size_t>{5, 7}, kTimes), IsEmpty());
  EXPECT_THAT(place::gaps_at(std::vector<std::size_t>{0, 3}, kTimes), IsEmpty());
  EXPECT_THAT(place::gaps_at({}, kTimes), IsEmpty());
  EXPECT_THAT(place::gaps_at(std::vector<std::size_t>{0, 1, 2}, std::vector<double>{0, 1, 2}), IsEmpty());
}

TEST(GapsAt, TwoJumpsBetweenTheSameKeyframesAreOne) {
  EXPECT_THAT(place::gaps_at(std::vector<std::size_t>{0, 3}, std::vector<double>{0, 10, 20, 21, 22, 23, 24}),
              ElementsAre(1));
}

TEST(GapsAt, RefusesKeyframesOutsideTheWalk) {
  EXPECT_THROW(place::gaps_at(std::vector<std::size_t>{0, 10}, kTimes), std::invalid_argument);
}

}  // namespace
