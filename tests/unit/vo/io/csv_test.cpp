#include "support/temporary_folder.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/csv.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;

TEST(Csv, ReadsColumnsByName) {
  const TemporaryFolder folder;
  const auto table = vo::CsvTable::read(folder.write("t.csv",
                                                     "\xEF\xBB\xBF"
                                                     "a, b,c\r\n1,2.5,x\r\n\r\n3,,y\r\n"));
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_TRUE(table.has("b"));
  EXPECT_THAT(table.indices("a"), ElementsAre(1, 3));
  EXPECT_THAT(table.text("c"), ElementsAre("x", "y"));
  EXPECT_THAT(table.optional_numbers("b"), ElementsAre(2.5, std::nullopt));
  EXPECT_THROW_WITH(table.numbers("b"), vo::Error, "t.csv: line 4: b is empty; expected a finite number");
  EXPECT_THROW_WITH(table.numbers("c"), vo::Error, "t.csv: line 2: c is 'x'");
  EXPECT_TRUE(table.has("B"));  // as some programs write names
  EXPECT_THAT(table.text("C"), ElementsAre("x", "y"));
  EXPECT_THAT(table.optional_indices("A"), ElementsAre(1, 3));
  EXPECT_THROW_WITH(table.optional_indices("b"), vo::Error, "t.csv: line 2: b is 2.5");
  EXPECT_THROW_WITH(table.numbers("d"), vo::Error,
                    "t.csv: has no column 'd'; expected it among those there are (a, b, c)");
}

TEST(Csv, NamesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a,b\n1,2\n3\n")), vo::Error,
                    "t.csv: line 3: has 1 cells; expected 2 as in the header");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "\n\n")), vo::Error, "t.csv: is empty");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder / "none.csv"), vo::Error, "none.csv: does not exist");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a\n1\n-2\n")).indices("a"), vo::Error,
                    "t.csv: line 3: a is -2; expected a whole number, 0 or greater");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a\n1\n1.5\n")).indices("a"), vo::Error,
                    "a is 1.5");
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a\nnan\n")).numbers("a"), vo::Error,
                    "a is 'nan'");
}

TEST(Csv, ReadsWhatSpreadsheetsWrite) {
  const TemporaryFolder folder;
  const auto reads = [&](std::string_view content) {
    const auto table = vo::CsvTable::read(folder.write("t.csv", content));
    EXPECT_THAT(table.numbers("a"), ElementsAre(1.5, -0.25)) << content;
    EXPECT_THAT(table.indices("b"), ElementsAre(2, 30)) << content;
  };
  reads("a,b\n1.5,2\n-.25,30\n");
  reads("a;b\n1,5;2\n-0,25;30\n");                          // decimal commas
  reads("a\tb\n1,5\t2\n-0.25\t30\n");                       // tabs, either mark
  reads("\"a\",\"b\"\n\"1.5\",\"2\"\n\"-0.25\",\"30\"\n");  // everything in quotes
  reads("\"a\",\"b\"\n\"1,5\",2\n\"-0,25\",30\n");          // quotes for the comma's sake
  reads("'a','b'\n'1.5','2'\n'-0.25','30'\n");              // single quotes
  reads("a;b\n '1,5' ; 2\n'-0,25';'30'\n");
  reads("# exported\na,b\n1.5,2\n# half way\n-0.25,30\n,\n,\n");  // comments, empty rows at the end
  reads(
      "\xEF\xBB\xBF"
      "sep=;\r\na;b\r\n1,5;2\r\n-0,25;30\r\n");
  reads("a,b\r1.5,2\r-0.25,+30\r");  // an old Macintosh
  reads(" a , b \n 1.5 , 2 \n -0.25 , 30 ");
  std::string utf16 = "\xFF\xFE";
  for (const char c : std::string("a\tb\r\n1,5\t2\r\n-0,25\t30\r\n")) utf16 += {c, '\0'};
  reads(utf16);  // "Unicode text"
}

TEST(Csv, AQuotedCellMayHoldSeparatorsAndQuotes) {
  const TemporaryFolder folder;
  const auto table =
      vo::CsvTable::read(folder.write("t.csv", "name;a\n\"Main; \"\"old\"\" street\";7\nplain \"x\";8\n"));
  EXPECT_THAT(table.text("name"), ElementsAre("Main; \"old\" street", "plain \"x\""));
  EXPECT_THAT(table.numbers("a"), ElementsAre(7, 8));
}

TEST(Csv, AnApostropheIsNoQuote) {
  const TemporaryFolder folder;
  const auto table = vo::CsvTable::read(
      folder.write("t.csv", "a,name\n1,'t Hoekje\n2,the dog's\n3,'Rock ''n'' Roll, \"Bar\"'\n4,''\n5,'\n"));
  EXPECT_THAT(table.text("name"), ElementsAre("'t Hoekje", "the dog's", "Rock 'n' Roll, \"Bar\"", "", "'"));
  for (const std::string name : {"'t Hoekje", "'quoted'", "''", "a'b"}) {
    const auto back = vo::CsvTable::read(folder.write("t.csv", "a,name\n1," + vo::csv_cell(name) + "\n"));
    EXPECT_THAT(back.text("name"), ElementsAre(name));
  }
}

TEST(Csv, ALineBreakInATextBecomesASpace) {
  const TemporaryFolder folder;
  const auto back = vo::CsvTable::read(folder.write("t.csv", "a,name\n1," + vo::csv_cell("a\nb") + "\n"));
  EXPECT_THAT(back.text("name"), ElementsAre("a b"));
}

TEST(Csv, AThousandIsNotTakenForADecimalComma) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::CsvTable::read(folder.write("t.csv", "a,b\n\"1,234\",1\n")).numbers("a"), vo::Error,
                    "a is '1,234'; expected a finite number");
  // Another cell shows what its commas are.
  const auto table = vo::CsvTable::read(folder.write("t.csv", "a,b\n\"1,234\",1\n\"1,5\",1\n"));
  EXPECT_THAT(table.numbers("a"), ElementsAre(1.234, 1.5));
}

TEST(Csv, ACommentOverNumbersIsAHeader) {
  const TemporaryFolder folder;
  const auto table = vo::CsvTable::read(folder.write("t.csv", "# EuRoC, 2016\n#time [ns],x [m]\n1,2\n3,4\n"));
  EXPECT_THAT(table.header(), ElementsAre("time [ns]", "x [m]"));
  EXPECT_THAT(table.numbers("x [m]"), ElementsAre(2, 4));
  const auto quoted = vo::CsvTable::read(folder.write("t.csv", "'#time [ns]','x [m]'\n'1','2'\n"));
  EXPECT_THAT(quoted.numbers("time [ns]"), ElementsAre(1));
}

TEST(Csv, LeavesOutWhatItIsToldTo) {
  const TemporaryFolder folder;
  const auto table =
      vo::CsvTable::read(folder.write("t.csv", "a,b\n1,2\n3\nnan,x\n"), vo::UnevenRows::kLeaveOut);
  EXPECT_EQ(table.left_out(), 1U);
  EXPECT_THAT(table.numbers_where_they_are("a"), ElementsAre(1, std::nullopt));
  EXPECT_THAT(table.numbers_where_they_are("b"), ElementsAre(2, std::nullopt));
  EXPECT_EQ(table.where(1), (folder / "t.csv").string() + ": line 4");
}

TEST(Csv, ACellMaySayThatThereIsNoValue) {
  const TemporaryFolder folder;
  for (const std::string cell : {"", "#N/A", "n/a", "NA", "NaN", "null", "-"}) {
    const vo::CsvTable table = vo::CsvTable::read(folder.write("t.csv", "a,b\n1," + cell + "\n2,3\n"));
    EXPECT_THAT(table.optional_numbers("b"), ElementsAre(std::nullopt, 3)) << cell;
    EXPECT_THAT(table.optional_indices("b"), ElementsAre(std::nullopt, 3)) << cell;
    EXPECT_THROW_WITH(table.numbers("b"), vo::Error, "t.csv: line 2: b is ");
  }
  for (const std::string cell : {"#DIV/0!", "none given", "--", "inf"}) {
    const vo::CsvTable table = vo::CsvTable::read(folder.write("t.csv", "a,b\n1," + cell + "\n"));
    EXPECT_THROW_WITH(table.optional_numbers("b"), vo::Error, "t.csv: line 2: b is '" + cell + "'");
  }
}

TEST(Csv, NumbersAreWholeCells) {
  EXPECT_EQ(vo::parse_number(" +1.5e3 "), 1500);
  EXPECT_EQ(vo::parse_number("-0,5", true), -0.5);
  for (const char* text : {"", "+", "+-1", "1 2", "1,2", "0x10", "inf", "nan", "1e999", "1.2.3"})
    EXPECT_FALSE(vo::parse_number(text)) << text;
  EXPECT_FALSE(vo::parse_number("1,234,567", true));
  EXPECT_FALSE(vo::parse_number("1.234,5", true));
}

TEST(Csv, TakesQuotesOutInTimeThatGrowsWithTheLine) {
  // A cell of blanks in quotes, again and again: each was looked at from the beginning of the cell.
  const TemporaryFolder folder;
  std::string line;
  for (int i = 0; i < 200'000; ++i) line += "\" \" ";
  const auto table = vo::CsvTable::read(folder.write("t.csv", "a,b\n" + line + ",\"x \"\"y\"\"\"\n"));
  EXPECT_THAT(table.text("a"), ElementsAre(""));
  EXPECT_THAT(table.text("b"), ElementsAre("x \"y\""));
}

TEST(Csv, StaysWhatItIsWhenItIsCopiedAndMoved) {
  const TemporaryFolder folder;
  auto table = vo::CsvTable::read(folder.write("t.csv", "a\nb\n"));
  const vo::CsvTable copy = table, moved = std::move(table);
  EXPECT_THAT(copy.text("a"), ElementsAre("b"));
  EXPECT_THAT(moved.text("a"), ElementsAre("b"));
}

}  // namespace
