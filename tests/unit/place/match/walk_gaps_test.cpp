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

}  // namespace
