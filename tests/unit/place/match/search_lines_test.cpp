#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/match/search_lines.hpp>
#include <place/match/sequence_search.hpp>

namespace {

using place::SequenceSearchOptions;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(SearchLines, OfNoRangeAreTheDiagonal) {
  const auto lines = place::search_lines({.length = 5, .search_range_rad = 0});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].slope, 1, 1e-15);  // tan(pi / 4)
  EXPECT_THAT(lines[0].offsets, ElementsAre(-2, -1, 0, 1, 2));
}

TEST(SearchLines, WorkedExampleOfVelocities) {
  // 0.5, 0.75, 1 at length 4, whose terms are at -2, -1, 0, 1; halves are rounded away from zero.
  const auto lines = place::search_lines({.length = 4, .v_min = 0.5, .v_max = 1.0});
  ASSERT_EQ(lines.size(), 2U);  // 1 gives the line of 0.75 again, which is searched once
  EXPECT_EQ(lines[0].slope, 0.5);
  EXPECT_THAT(lines[0].offsets, ElementsAre(-1, -1, 0, 1));
  EXPECT_EQ(lines[1].slope, 0.75);
  EXPECT_THAT(lines[1].offsets, ElementsAre(-2, -1, 0, 1));
}

TEST(SearchLines, OpenSeqSlamsVelocitiesHaveBothEnds) {
  // 0.8 .. 1.2 in steps of 1 / 50: 1.2 is one of them, although 0.4 * 50 is less than 20 in floating point.
  const auto lines = place::search_lines({.length = 50, .v_min = 0.8, .v_max = 1.2});
  EXPECT_EQ(lines.front().slope, 0.8);
  EXPECT_DOUBLE_EQ(lines.back().slope, 1.2);
}

TEST(SearchLines, AreDistinctAndPassThroughThePair) {
  for (const int length : {1, 2, 9, 10}) {
    for (const double range_rad : {0.05, 0.5, 0.78}) {
      SCOPED_TRACE(testing::Message() << length << " keyframes, " << range_rad << " rad");
      const auto lines = place::search_lines({.length = length, .search_range_rad = range_rad});
      ASSERT_FALSE(lines.empty());
      for (std::size_t i = 0; i < lines.size(); ++i) {
        ASSERT_EQ(lines[i].offsets.size(), static_cast<std::size_t>(length));
        EXPECT_EQ(lines[i].offsets[static_cast<std::size_t>(length / 2)], 0);
        for (int k = 0; k < length; ++k) {
          // The nearest whole keyframe to the line.
          EXPECT_LE(
              std::abs(lines[i].offsets[static_cast<std::size_t>(k)] - (k - length / 2) * lines[i].slope),
              0.5 + 1e-9);
        }
        if (i == 0) continue;
        EXPECT_LT(lines[i - 1].slope, lines[i].slope);
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(lines[i].offsets, lines[j].offsets);
      }
    }
  }
  // A line of one keyframe has no slope to tell.
  EXPECT_EQ(place::search_lines({.length = 1, .search_range_rad = 0.78}).size(), 1U);
}

TEST(SearchLines, ReachAsFarAsTheSteepestOfThem) {
  EXPECT_EQ(place::reach_of({}), 0U);
  EXPECT_EQ(place::reach_of({{1, {-2, -1, 0, 1}}, {2, {-4, -2, 0, 2}}}), 4U);  // back, of an even length
  EXPECT_EQ(place::reach_of({{1, {-1, 0, 1, 2}}, {1, {0, 3}}}), 3U);
}

TEST(SequenceSearchOptions, SayWhatIsWrongWithThem) {
  const auto reason_of = [](const SequenceSearchOptions& options) {
    std::string reason;
    EXPECT_FALSE(options.is_valid(&reason));
    EXPECT_FALSE(options.is_valid(nullptr));
    EXPECT_THROW(place::search_lines(options), std::invalid_argument);
    EXPECT_THROW(place::search_sequences(place::make_cost_matrix(0, 0), options), std::invalid_argument);
    return reason;
  };
  EXPECT_TRUE(SequenceSearchOptions{}.is_valid(nullptr));
  EXPECT_THAT(reason_of({.length = 0}), HasSubstr("length is 0; at least 1"));
  EXPECT_THAT(reason_of({.search_range_rad = 0.81}), HasSubstr("range is 0.81 rad; 0 <= range <= 0.8"));
  EXPECT_THAT(reason_of({.search_range_rad = -0.1}), HasSubstr("range is -0.1"));
  EXPECT_THAT(reason_of({.search_range_rad = std::nan("")}), HasSubstr("range is nan"));
  EXPECT_THAT(reason_of({.slopes = 0}), HasSubstr("slopes is 0"));
  EXPECT_THAT(reason_of({.v_min = 0.8}), HasSubstr("both or neither"));
  EXPECT_THAT(reason_of({.v_max = 1.2}), HasSubstr("both or neither"));
  EXPECT_THAT(reason_of({.v_min = 1.2, .v_max = 0.8}), HasSubstr("1.2..0.8; 0 < v_min <= v_max"));
  EXPECT_THAT(reason_of({.v_min = 0, .v_max = 1}), HasSubstr("0..1"));
  EXPECT_THAT(reason_of({.v_min = 1, .v_max = std::numeric_limits<double>::infinity()}), HasSubstr("1..inf"));
  EXPECT_THAT(reason_of({.min_fraction = 0}), HasSubstr("fraction is 0; 0 < fraction <= 1"));
  EXPECT_THAT(reason_of({.min_fraction = 1.5}), HasSubstr("fraction is 1.5"));
  EXPECT_THAT(reason_of({.uniqueness_window = -1}), HasSubstr("window is -1"));
}

}  // namespace
