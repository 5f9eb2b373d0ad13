#include "route/sqlite.hpp"

#include "support/temporary_folder.hpp"

#include <filesystem>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::sqlite::Database;
using test_support::TemporaryFolder;

std::int64_t sum(const std::filesystem::path& file) {
  const Database database(file, Database::Mode::kReadOnly, "shown.db");
  auto rows = database.prepare("SELECT sum(x) FROM t");
  return rows.step() ? rows.integer() : -1;
}

/// A database in WAL mode, as other programs leave it, with a row in the file and, if asked for, one beside
/// it. The connection that wrote it is gone without having brought them together, as after a power cut.
std::filesystem::path wal_database(const TemporaryFolder& folder, bool changes_wait) {
  const auto file = folder / "wal.db";
  {
    const Database database(file, Database::Mode::kCreate, "shown.db");
    database.run("PRAGMA journal_mode = WAL; CREATE TABLE t(x); INSERT INTO t VALUES(1)");
  }
  if (changes_wait) {
    const auto copy = folder / "copy.db";
    {
      const Database database(file, Database::Mode::kCreate, "shown.db");
      database.run("PRAGMA wal_autocheckpoint = 0; INSERT INTO t VALUES(41)");
      std::filesystem::copy_file(file, copy);
      std::filesystem::copy_file(file.string() + "-wal", copy.string() + "-wal");
    }
    return copy;
  }
  return file;
}

/// Media that cannot be written: SQLite cannot make the index it needs, as a folder is in its place.
void block_index(const std::filesystem::path& file) {
  std::filesystem::remove(file.string() + "-shm");
  std::filesystem::create_directory(file.string() + "-shm");
}

TEST(Sqlite, ReadsWalFilesWhereNothingCanBeWritten) {
  const TemporaryFolder folder;
  const auto file = wal_database(folder, false);
  EXPECT_EQ(sum(file), 1);
  block_index(file);
  EXPECT_EQ(sum(file), 1);
}

TEST(Sqlite, ReadsChangesThatWaitBesideTheFile) {
  const TemporaryFolder folder;
  const auto file = wal_database(folder, true);
  block_index(file);
  EXPECT_EQ(sum(file), 42);
  EXPECT_TRUE(std::filesystem::exists(file.string() + "-wal"));  // untouched
}

TEST(Sqlite, PathsMayHoldWhatAddressesMayNot) {
  const TemporaryFolder folder;
  const auto odd = folder / "a?b%20 #c.db";
  std::filesystem::rename(wal_database(folder, false), odd);
  block_index(odd);
  EXPECT_EQ(sum(odd), 1);
}

TEST(Sqlite, FoldsChangesIn) {
  const TemporaryFolder folder;
  const auto file = wal_database(folder, true);
  place::sqlite::fold_changes(file);
  EXPECT_FALSE(std::filesystem::exists(file.string() + "-wal"));
  EXPECT_EQ(sum(file), 42);
  place::sqlite::fold_changes(folder / "none.db");  // nothing to do
  EXPECT_FALSE(std::filesystem::exists(folder / "none.db"));
}

TEST(Sqlite, NamesTheFile) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(
      Database(folder.write("x.db", std::string(4096, 'x')), Database::Mode::kReadOnly, "shown.db"),
      vo::Error, "shown.db: is no route database");
}

}  // namespace
