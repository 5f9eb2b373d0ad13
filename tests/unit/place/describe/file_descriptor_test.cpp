#include "place/describe/file_descriptor.hpp"

#include "place/describe/npy.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::FloatRows;
using place::KeyframeRecords;
using testing::ElementsAre;

class FileDescriptor : public testing::Test {
 protected:
  /// Rows 10, 20, 30 of frames 0, 10 and 20, a tenth of a second apart.
  FileDescriptor() {
    place::write_npy(folder_ / "walk.npy", FloatRows{.width = 1, .values = {10, 20, 30}});
    folder_.write("walk.npy.csv", "frame,time_s\n0,0\n10,0.1\n20,0.2\n");
  }
  [[nodiscard]] FloatRows described(const KeyframeRecords& keyframes, const char* name = "walk.npy") const {
    const auto descriptor = place::make_file({.file = {.path = (folder_ / name).string()}});
    return std::get<FloatRows>(descriptor->describe(keyframes, {}));
  }
  test_support::TemporaryFolder folder_;
};

TEST_F(FileDescriptor, TakesTheRowOfTheFrameOrTheNearest) {
  const FloatRows rows = described({.frames = {0, 4, 10, 16, 25}, .time_s = {0, 0.04, 0.1, 0.16, 0.25}});
  EXPECT_THAT(rows.values, ElementsAre(10, 10, 20, 30, 30));
  EXPECT_EQ(described({}).size(), 0U);
}

TEST_F(FileDescriptor, RefusesAnotherWalk) {
  EXPECT_THROW_WITH(described({.frames = {100}, .time_s = {1.0}}), vo::Error, "frame 100");
}

TEST_F(FileDescriptor, SaysWhichFileIsWrong) {
  EXPECT_THROW_WITH(described({.frames = {0}, .time_s = {0}}, "none.npy"), vo::Error, "none.npy");
  EXPECT_THROW_WITH(place::make_file({}), vo::Error, "descriptor-file: is missing");
  folder_.write("walk.npy.csv", "frame,time_s\n0,0\n");
  EXPECT_THROW_WITH(described({.frames = {0}, .time_s = {0}}), vo::Error, "has 1 rows");
  folder_.write("walk.npy.csv", "frame,time_s\n0,0\n20,0.2\n10,0.1\n");
  EXPECT_THROW_WITH(described({.frames = {0}, .time_s = {0}}), vo::Error, "order of time");
}

}  // namespace
