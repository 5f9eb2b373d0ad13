#include "support/temporary_folder.hpp"

#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/io/csv_columns.hpp>

namespace {

using test_support::TemporaryFolder;

struct Row {
  int number = 0;
  std::string word = "none";
};

constexpr std::array kColumns{
    vo::CsvColumn<Row>{"number", [](const Row& row) { return std::to_string(row.number); },
                       [](Row& row, std::string_view cell) {
                         const auto value = vo::parse_number(cell);
                         if (value) row.number = static_cast<int>(*value);
                         return value.has_value();
                       },
                       "a finite number"},
    vo::CsvColumn<Row>{"twice", [](const Row& row) { return std::to_string(2 * row.number); }},
    vo::CsvColumn<Row>{"word", [](const Row& row) { return row.word; },
                       [](Row& row, std::string_view cell) {
                         row.word = cell;
                         return true;
                       },
                       "", false}};

TEST(CsvColumns, WriteAHeaderAndARowEach) {
  const std::vector<Row> rows{{1, "a"}, {-2, "b"}};
  EXPECT_EQ(vo::to_csv<Row>(rows, kColumns), "number,twice,word\n1,2,a\n-2,-4,b\n");
  EXPECT_EQ(vo::to_csv<Row>({}, kColumns), "number,twice,word\n");
}

TEST(CsvColumns, ReadBackWhatTheyWrote) {
  const TemporaryFolder folder;
  const auto rows = vo::read_csv<Row>(
      folder.write("a.csv", vo::to_csv<Row>(std::vector<Row>{{3, "c"}}, kColumns)), kColumns);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].number, 3);
  EXPECT_EQ(rows[0].word, "c");
}

TEST(CsvColumns, MayMissWhatIsNotRequired) {
  const TemporaryFolder folder;
  const auto rows = vo::read_csv<Row>(folder.write("a.csv", "other,number\nx,5\n"), kColumns);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].number, 5);
  EXPECT_EQ(rows[0].word, "none");
  EXPECT_THROW_WITH(vo::read_csv<Row>(folder.write("b.csv", "word\nx\n"), kColumns), vo::Error,
                    "has no column 'number'");
}

TEST(CsvColumns, NameTheCellThatIsOfAnotherKind) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::read_csv<Row>(folder.write("a.csv", "number\n5\nfive\n"), kColumns), vo::Error,
                    "a.csv: line 3: number is 'five'; expected a finite number");
}

TEST(CsvNumber, IsAWholeFiniteCell) {
  EXPECT_EQ(vo::parse_number("-1.5e2"), -150);
  for (const char* none : {"", "nan", "inf", "1 2", "1,5", "x"}) EXPECT_FALSE(vo::parse_number(none)) << none;
}

}  // namespace
