#include "place/evaluation/sweep_parts.hpp"

#include "support/temporary_folder.hpp"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::SweepCell;
using place::SweepPart;

TEST(SweepParts, AreReadFromText) {
  const SweepPart part = place::parse_part("2/8");
  EXPECT_EQ(part.number, 2);
  EXPECT_EQ(part.of, 8);
  for (const char* none : {"", "2", "0/4", "5/4", "-1/4", "1/0", "1/4x", "1.5/4", "/", "a/b", "1/ 4"})
    EXPECT_THROW_WITH(place::parse_part(none), vo::Error, "I/N with 1 <= I <= N");
}

TEST(SweepParts, CoverEverythingOnceAndAreEven) {
  for (const std::size_t total : {0U, 1U, 7U, 20U, 1000U}) {
    for (const std::size_t of : {1U, 2U, 3U, 8U, 64U}) {
      std::size_t next = 0;
      for (std::size_t i = 1; i <= of; ++i) {
        const auto [begin, end] = place::range_of_part({i, of}, total);
        EXPECT_EQ(begin, next);
        EXPECT_THAT(end - begin, testing::AnyOf(total / of, total / of + 1));
        next = end;
      }
      EXPECT_EQ(next, total);
    }
  }
}

TEST(SweepParts, KeepCellsOfOneReadingAndOneMatrixTogether) {
  // The length is the slowest axis, but neither what is read (every) nor the matrix depends on it.
  const std::vector<place::SweepAxis> axes{
      {"sequence-length", {"5", "10"}}, {"max-shift-px", {"0", "2"}}, {"sampling-n", {"3", "6"}}};
  const std::vector<SweepCell> cells = place::cells_by_work(axes);
  std::vector<SweepCell> sorted = cells, all = place::all_cells(axes);
  std::ranges::sort(sorted);
  std::ranges::sort(all);
  EXPECT_EQ(sorted, all);
  for (std::size_t i = 0; i < cells.size(); i += 2) {
    EXPECT_EQ(SweepCell(cells[i].begin() + 1, cells[i].end()),
              SweepCell(cells[i + 1].begin() + 1, cells[i + 1].end()));
  }
}

TEST(SweepParts, HaveACellThatIsNamedTwiceOnce) {
  EXPECT_EQ(place::cells_by_work({{"sequence-length", {"5", "5"}}}), (std::vector<SweepCell>{{"5"}}));
}

TEST(SweepCsv, HoldsAResultAsItIsWritten) {
  const test_support::TemporaryFolder folder;
  place::CellResult result{.query_keyframes = 3, .reference_keyframes = 4, .max_f1 = 2.0 / 3};
  result.max_f1_threshold = -1e-7 / 3;
  result.recall = 1;
  const place::CellResult written = place::as_written(result);
  EXPECT_DOUBLE_EQ(written.max_f1, 0.666666667);
  EXPECT_EQ(written.recall, 1);
  const std::vector<place::SweepAxis> axes{{"motion", {"sad"}}};
  std::ofstream(folder.path() / "sweep.csv") << place::sweep_csv(axes, {{{"sad"}, result}});
  const auto read = place::read_sweep(folder.path() / "sweep.csv", axes);
  EXPECT_EQ(read.at({"sad"})->max_f1, written.max_f1);
  EXPECT_EQ(read.at({"sad"})->max_f1_threshold, written.max_f1_threshold);
}

}  // namespace
