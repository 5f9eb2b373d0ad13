#include "support/temporary_folder.hpp"

#include <cerrno>
#include <filesystem>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/io/partial_path.hpp>

namespace {

namespace fs = std::filesystem;
using test_support::TemporaryFolder;

TEST(PartialPath, IsRemovedUnlessItGetsItsName) {
  const TemporaryFolder folder;
  {
    const vo::PartialPath file(folder.write("file.partial", "half"));
    fs::create_directory(folder / "part");
    const vo::PartialPath part(folder / "part");
    folder.write("part/file", "half");
  }
  EXPECT_FALSE(fs::exists(folder / "file.partial"));
  EXPECT_FALSE(fs::exists(folder / "part"));

  folder.write("file", "old");
  {
    vo::PartialPath file(folder.write("file.partial", "whole"));
    EXPECT_EQ(file.rename_to(folder / "file"), 0);
    folder.write("file.partial", "another's");
  }
  EXPECT_EQ(fs::file_size(folder / "file"), 5U);
  EXPECT_TRUE(fs::exists(folder / "file.partial"));
}

TEST(PartialPath, KeepsWhatIsNotEmptyWhereOnlyEmptyFoldersGo) {
  const TemporaryFolder folder;
  for (const char* name : {"empty", "full"}) fs::create_directory(folder / name);
  folder.write("full/file", "kept");
  {
    const vo::PartialPath empty(folder / "empty", vo::Removal::kIfEmpty);
    const vo::PartialPath full(folder / "full", vo::Removal::kIfEmpty);
  }
  EXPECT_FALSE(fs::exists(folder / "empty"));
  EXPECT_TRUE(fs::exists(folder / "full" / "file"));
}

TEST(PartialPath, SaysWhyItCannotBeRenamed) {
  const TemporaryFolder folder;
  vo::PartialPath missing(folder / "missing");
  EXPECT_EQ(missing.rename_to(folder / "name"), ENOENT);
}

/// In a process of its own, which ends as a program does that was told to.
TEST(PartialPathDeathTest, AllOfAProcessCanBeDiscarded) {
  const TemporaryFolder folder;
  const auto told_to_end = [&] {
    fs::create_directory(folder / "run");
    const vo::PartialPath made(folder / "run", vo::Removal::kIfEmpty);
    fs::create_directory(folder / "run" / "part");
    const vo::PartialPath part(folder / "run" / "part");
    folder.write("run/part/file", "half");
    const vo::PartialPath file(folder.write("route.partial", "half"));
    vo::discard_partial_paths();
    _exit(130);
  };
  EXPECT_EXIT(told_to_end(), testing::ExitedWithCode(130), "");
  EXPECT_FALSE(fs::exists(folder / "run"));
  EXPECT_FALSE(fs::exists(folder / "route.partial"));
}

}  // namespace
