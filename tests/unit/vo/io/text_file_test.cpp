#include "support/temporary_folder.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/text_file.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;

std::vector<std::string> lines_of(std::string_view content) {
  const TemporaryFolder folder;
  std::vector<std::string> lines;
  const vo::TextFile file = vo::read_text_file(folder.write("t", content), "a text");
  for (const vo::TextLine& line : file.lines) lines.emplace_back(line.text);
  return lines;
}

TEST(TextFile, EndsLinesAsAnyProgramDoes) {
  EXPECT_THAT(lines_of("a\nb\r\n\rc"), ElementsAre("a", "b", "", "c"));
  EXPECT_THAT(lines_of("a\n"), ElementsAre("a"));
  EXPECT_THAT(lines_of(""), ElementsAre());
  const TemporaryFolder folder;
  const vo::TextFile file = vo::read_text_file(folder.write("t", "a\r\n\r\nb"), "a text");
  EXPECT_EQ(file.lines[2].number, 3U);
}

TEST(TextFile, DecodesByTheByteOrderMark) {
  EXPECT_THAT(lines_of("\xEF\xBB\xBF"
                       "caf\xC3\xA9"),
              ElementsAre("caf\xC3\xA9"));
  // "é€" and U+1F6B6, a pair of surrogates.
  const std::string little("\xFF\xFE\xE9\x00\xAC\x20\x3D\xD8\xB6\xDE", 10);
  const std::string big("\xFE\xFF\x00\xE9\x20\xAC\xD8\x3D\xDE\xB6", 10);
  EXPECT_THAT(lines_of(little), ElementsAre("\xC3\xA9\xE2\x82\xAC\xF0\x9F\x9A\xB6"));
  EXPECT_EQ(lines_of(big), lines_of(little));
  EXPECT_THAT(lines_of(std::string("\xFF\xFE\x3D\xD8\x41\x00\x00\xDC\x7A", 9)), ElementsAre("?A?"));
}

TEST(TextFile, Utf16NeedsNoMark) {
  const auto widened = [](std::string_view text, bool big_endian) {
    std::string wide;
    for (const char c : text) wide += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
    return wide;
  };
  for (const bool big_endian : {false, true})
    EXPECT_THAT(lines_of(widened("a,b\r\n1,2\r\n", big_endian)), ElementsAre("a,b", "1,2"));
  const std::string binary("\0\0a\0", 4);
  EXPECT_THAT(lines_of(binary), ElementsAre(binary));
}

TEST(TextFile, SaysWhatItShouldHaveBeen) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::read_text_file(folder / "none", "a text"), vo::Error,
                    "none: does not exist; expected a text");
  EXPECT_THROW_WITH(vo::read_text_file(folder.path(), "a text"), vo::Error,
                    "cannot be read; expected a text");
}

TEST(TextFile, ShowsOnlyWhatCanBeShown) {
  EXPECT_EQ(vo::printable("\x7f\x02\xffz"), "???z");
  const std::string shown = vo::printable(std::string(50, 'a'));
  EXPECT_EQ(shown.size(), 43u);
  EXPECT_THAT(shown, testing::EndsWith("a..."));
  EXPECT_EQ(vo::trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(vo::trimmed(" \t\r\n"), "");
}

}  // namespace
