#include "support/temporary_folder.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

namespace {

using test_support::read_file;
using test_support::TemporaryFolder;

TEST(AtomicFile, WritesWholeOrNotAtAll) {
  const TemporaryFolder folder;
  vo::write_file(folder / "a.txt", "one");
  EXPECT_EQ(read_file(folder / "a.txt"), "one");
  {
    const vo::AtomicFile file(folder / "a.txt");
    std::ofstream(file.temporary()) << "half";
  }
  EXPECT_EQ(read_file(folder / "a.txt"), "one");
  vo::write_file(folder / "a.txt", "two");
  EXPECT_EQ(read_file(folder / "a.txt"), "two");
  // Nothing but the file is left behind.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(AtomicFile, SaysWhyItCannotWrite) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(vo::write_file(folder / "none" / "a.txt", "x"), vo::Error,
                    "a.txt: cannot be written: No such file");
}

}  // namespace
