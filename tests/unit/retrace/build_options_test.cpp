#include "build_options.hpp"

#include "support/temporary_folder.hpp"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using retrace::BuildOptions;
using retrace::check_build;
using test_support::TemporaryFolder;

/// A walk to be added to a route in the folder.
BuildOptions walk_into(const TemporaryFolder& folder) {
  BuildOptions options;
  options.walk = {"walks/day.mp4"};
  options.output = (folder / "route.db").string();
  return options;
}

TEST(BuildOptions, ATraverseIsCalledAsItsRecording) {
  const TemporaryFolder folder;
  const auto name_of = [&](const std::string& walk) {
    BuildOptions options = walk_into(folder);
    options.walk = {walk, "another.mp4"};
    check_build(options);
    return options.name;
  };
  EXPECT_EQ(name_of("walks/day.mp4"), "day");
  EXPECT_EQ(name_of("walks/day/"), "day");
  EXPECT_EQ(name_of("day.2.mp4"), "day.2");
  BuildOptions named = walk_into(folder);
  named.name = "evening";
  check_build(named);
  EXPECT_EQ(named.name, "evening");
}

TEST(BuildOptions, AFolderIsImportedAlone) {
  BuildOptions alone;
  alone.import = "folder";
  EXPECT_NO_THROW(check_build(alone));
  const auto with = [&](const auto& give) {
    BuildOptions options = alone;
    give(options);
    EXPECT_THROW_WITH(check_build(options), retrace::UsageError, "--import: leaves no choice of a walk");
  };
  with([](BuildOptions& o) { o.walk = {"day.mp4"}; });
  with([](BuildOptions& o) { o.name = "day"; });
  with([](BuildOptions& o) { o.settings.motion = "steps"; });
  with([](BuildOptions& o) { o.survey.truth = "truth.csv"; });
  with([](BuildOptions& o) { o.places = "places.csv"; });
  with([](BuildOptions& o) { o.report = "day.html"; });
  BuildOptions neither;
  EXPECT_THROW_WITH(check_build(neither), retrace::UsageError, "walk: is missing");
}

TEST(BuildOptions, AReportIsANewFileOfItsOwn) {
  const TemporaryFolder folder;
  BuildOptions options = walk_into(folder);
  options.report = (folder / "day.html").string();
  EXPECT_NO_THROW(check_build(options));
  folder.write("day.html", "earlier");
  EXPECT_THROW_WITH(check_build(options), vo::Error, "day.html: already exists");
  options.common.force = true;
  EXPECT_NO_THROW(check_build(options));
  folder.write("route.db", "");
  std::filesystem::create_symlink(folder / "route.db", folder / "link.html");
  options.report = (folder / "link.html").string();
  EXPECT_THROW_WITH(check_build(options), vo::Error, "link.html: is the route itself");
  options.report = (folder / "none" / "day.html").string();
  EXPECT_THROW_WITH(check_build(options), vo::Error, "none: is no folder");
}

TEST(BuildOptions, ATraverseIsReplacedOnlyByForce) {
  place::Route route;
  BuildOptions options;
  options.output = "route.db";
  options.name = "day";
  EXPECT_NO_THROW(check_name_is_free(options, route));
  route.traverses.emplace_back().name = "day";
  EXPECT_THROW_WITH(check_name_is_free(options, route), vo::Error, "route.db: already has a traverse 'day'");
  options.common.force = true;
  EXPECT_NO_THROW(check_name_is_free(options, route));
}

}  // namespace
