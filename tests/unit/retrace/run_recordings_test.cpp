#include "run_recordings.hpp"

#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using retrace::traverse_files;
using testing::ElementsAre;

place::Route route_of(const std::vector<std::string>& names) {
  place::Route route;
  for (const std::string& name : names) route.traverses.emplace_back().name = name;
  return route;
}

TEST(TraverseFiles, OfTheOnlyTraverseNeedNoName) {
  EXPECT_THAT(traverse_files({"a=b.mp4", "c.mp4"}, route_of({"day"})).at("day"),
              ElementsAre("a=b.mp4", "c.mp4"));
}

TEST(TraverseFiles, AreNamedAndANameMayHoldAnEqualsSign) {
  const auto files = traverse_files({"a=b=1.mp4", "a=x=2.mp4", "a=b=3.mp4"}, route_of({"a", "a=b", "c"}));
  EXPECT_EQ(files.size(), 2U);
  EXPECT_THAT(files.at("a=b"), ElementsAre("1.mp4", "3.mp4"));
  EXPECT_THAT(files.at("a"), ElementsAre("x=2.mp4"));
}

TEST(TraverseFiles, OfNoTraverseAreRefused) {
  for (const char* given : {"1.mp4", "d=1.mp4", "=1.mp4"})
    EXPECT_THROW_WITH(traverse_files({given}, route_of({"a", "c"})), vo::Error,
                      "does not name a traverse; expected NAME=FILE, NAME being one of a, c");
}

}  // namespace
