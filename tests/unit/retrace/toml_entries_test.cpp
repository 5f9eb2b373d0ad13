#include "toml_entries.hpp"

#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using test_support::TemporaryFolder;
using testing::ElementsAre;

std::vector<retrace::TomlEntry> entries_of(const std::string& text) {
  const TemporaryFolder folder;
  return retrace::read_toml(folder.write("a.toml", text).string(), "a file");
}

TEST(TomlEntries, HaveSectionsKeysAndValues) {
  const auto entries = entries_of("one = 1\n[first]\ntwo = \"a b\"  # of it\nthree = [\"c\", \"d # e\"]\n");
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].section, "");
  EXPECT_EQ(entries[0].key, "one");
  EXPECT_THAT(entries[0].values, ElementsAre("1"));
  EXPECT_EQ(entries[1].section, "first");
  EXPECT_THAT(entries[1].values, ElementsAre("a b"));
  EXPECT_THAT(entries[2].values, ElementsAre("c", "d # e"));
}

TEST(TomlEntries, DotsAreOfTheNameHoweverMany) {
  const std::string name = "a" + std::string(20'000, '.') + "b";  // once a gigabyte of names
  const auto entries = entries_of("[" + name + "]\nkey.part = 1\n");
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].section, name);
  EXPECT_EQ(entries[0].key, "key.part");
}

TEST(TomlEntries, OfNoTextAreRefused) {
  EXPECT_THROW_WITH(entries_of(std::string("[a") + '\0' + "]\n"), vo::Error, "a.toml: is no text");
  EXPECT_THROW_WITH(retrace::read_toml("none.toml", "a file"), vo::Error,
                    "none.toml: is no file; expected a file");
}

}  // namespace
