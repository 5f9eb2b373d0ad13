#include "place/certainty/not_found.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace place {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// So many matches, the first of them accepted.
std::vector<Match> matches_of(std::size_t all, std::size_t accepted, std::optional<double> probability) {
  std::vector<Match> matches(all);
  for (std::size_t i = 0; i < all; ++i) {
    matches[i].accepted = i < accepted;
    if (probability) matches[i].probability = *probability / static_cast<double>(i + 1);
  }
  return matches;
}

TEST(NotFound, SaysHowManyOfAWalkAreAccepted) {
  const auto none = not_found("night.mp4", matches_of(40, 0, 0.31));
  ASSERT_TRUE(none);
  EXPECT_THAT(*none,
              HasSubstr("night.mp4: none of 40 keyframes accepted (the surest has a probability of 0.31)"));
  EXPECT_THAT(*none, HasSubstr("retrace doctor"));
  const auto one = not_found("night.mp4", matches_of(40, 1, {}));
  ASSERT_TRUE(one);
  EXPECT_THAT(*one, HasSubstr("only 1 of 40 keyframes accepted:"));
  EXPECT_THAT(*one, Not(HasSubstr("the surest has")));
}

TEST(NotFound, ATwentiethIsFound) {
  EXPECT_FALSE(not_found("a", matches_of(40, 2, 0.9)));
  EXPECT_TRUE(not_found("a", matches_of(41, 2, 0.9)));
  EXPECT_FALSE(not_found("a", matches_of(1, 1, 0.9)));
  EXPECT_TRUE(not_found("a", matches_of(1, 0, 0.9)));
  EXPECT_FALSE(not_found("a", {}));
}

}  // namespace
}  // namespace place
