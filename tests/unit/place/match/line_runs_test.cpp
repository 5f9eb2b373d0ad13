#include "match/line_runs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

TEST(LineRuns, WorkedExample) {
  // Slope 1 is one run; slope 0.5 of offsets -1 -1 0 1 (length 4: -2, -1, 0, 1) two of step 1: -1 | -1 0 1.
  const auto lines = place::search_lines({.length = 4, .v_min = 0.5, .v_max = 0.5});
  const auto runs = place::line_runs(lines, 100, 100);
  EXPECT_THAT(runs.steps, testing::ElementsAre(1));
  ASSERT_EQ(runs.runs.size(), 2U);
  EXPECT_EQ(runs.runs[0].first_query, -2);
  EXPECT_EQ(runs.runs[0].last_query, -2);
  EXPECT_EQ(runs.runs[1].first_query, -1);
  EXPECT_EQ(runs.runs[1].first_reference, -1);
  EXPECT_EQ(runs.runs[1].last_query, 1);
  EXPECT_EQ(runs.runs[1].last_reference, 1);
}

TEST(LineRuns, CoverEveryTermOnce) {
  for (const double range_rad : {0.0, 0.1, 0.5, 0.78}) {
    const auto lines = place::search_lines({.length = 23, .search_range_rad = range_rad});
    const auto runs = place::line_runs(lines, 1000, 100000);
    auto run = runs.runs.begin();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::vector<int> offsets;
      for (std::uint32_t left = runs.counts[i]; left > 0; --left, ++run) {
        const int step = runs.steps[run->ring];
        for (int q = run->first_query; q <= run->last_query; ++q) {
          EXPECT_EQ(q, static_cast<int>(offsets.size()) - 11);
          offsets.push_back(run->first_reference + (q - run->first_query) * step);
        }
        EXPECT_EQ(offsets.back(), run->last_reference);
      }
      EXPECT_EQ(offsets, lines[i].offsets);
    }
  }
}

TEST(LineRuns, AreFewNearWholeSlopes) {
  // One more for each half keyframe that a line strays from the diagonal, whatever its length.
  for (const int length : {10, 50, 200}) {
    const auto lines =
        place::search_lines({.length = length, .v_min = 1 - 2.0 / length, .v_max = 1 - 2.0 / length});
    EXPECT_LE(place::line_runs(lines, 1000, 1000).runs.size(), 5U) << length;
  }
}

}  // namespace
