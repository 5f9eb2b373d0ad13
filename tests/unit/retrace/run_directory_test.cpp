#include "run_directory.hpp"

#include "support/temporary_folder.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using namespace retrace;
using test_support::read_file;
using test_support::TemporaryFolder;

TEST(RunDirectory, IsMadeAndHoldsNoEarlierRun) {
  const TemporaryFolder folder;
  prepare_run_directory(folder / "a/b", {"matches.csv"}, false);
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a/b"));
  folder.write("a/b/other.csv", "");
  EXPECT_NO_THROW(prepare_run_directory(folder / "a/b", {"matches.csv"}, false));
  folder.write("a/b/matches.csv", "");
  EXPECT_THROW_WITH(prepare_run_directory(folder / "a/b", {"matches.csv"}, false), vo::Error,
                    "b/matches.csv: already exists");
  EXPECT_NO_THROW(prepare_run_directory(folder / "a/b", {"matches.csv"}, true));
  EXPECT_THROW_WITH(prepare_run_directory(folder / "a/b/other.csv", {}, true), vo::Error, "is no folder");
}

TEST(RunDirectory, FilesAppearTogetherAndStaleOnesGo) {
  const TemporaryFolder folder;
  folder.write("matches.csv", "old");
  folder.write("metrics.json", "old");
  folder.write("notes.txt", "of the user");
  {
    StagedFiles staged(folder.path());
    std::filesystem::copy_file(folder / "notes.txt", staged.path() / "matches.csv");
    EXPECT_EQ(read_file(folder / "matches.csv"), "old");
  }
  EXPECT_EQ(read_file(folder / "matches.csv"), "old");  // it was not committed
  StagedFiles staged(folder.path());
  std::filesystem::copy_file(folder / "notes.txt", staged.path() / "matches.csv");
  staged.commit({"matches.csv", "metrics.json"});
  EXPECT_EQ(read_file(folder / "matches.csv"), "of the user");
  EXPECT_FALSE(std::filesystem::exists(folder / "metrics.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "notes.txt"));
}

TEST(RunDirectory, ANewFileIsNotThereYet) {
  const TemporaryFolder folder;
  const auto file = folder / "side.mp4";
  EXPECT_NO_THROW(check_new_file(file, false, "another name"));
  folder.write("side.mp4", "");
  EXPECT_THROW_WITH(check_new_file(file, false, "another name"), vo::Error,
                    "side.mp4: already exists; expected another name, or --force to overwrite");
  EXPECT_NO_THROW(check_new_file(file, true, "another name"));
  EXPECT_NO_THROW(check_writable(file));
  EXPECT_THROW_WITH(check_new_file(folder.path(), true, "another name"), vo::Error, "is a folder");
  EXPECT_THROW_WITH(check_new_file(folder / "none/side.mp4", true, "another name"), vo::Error,
                    "is no folder");
}

TEST(RunDirectory, OfAnEarlierCommandIsThere) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_written_by("localise", folder.path()));
  EXPECT_THROW_WITH(check_written_by("localise", folder / "run"), vo::Error,
                    "run: is no folder; expected one written by `retrace localise`");
}

TEST(RunDirectory, AWalkAndARouteAreNotSwapped) {
  const TemporaryFolder folder;
  const std::string walk = folder.write("walk.mp4", "video").string();
  const std::string route = folder.write("route.db", std::string("SQLite format 3\0", 16)).string();
  EXPECT_NO_THROW(check_not_swapped(walk, route));
  EXPECT_THROW_WITH(check_not_swapped(route, walk), vo::Error, "is a route database, given as the walk");
  EXPECT_NO_THROW(check_not_swapped(route, route));  // what is wrong here is said when the walk is read
}

}  // namespace
