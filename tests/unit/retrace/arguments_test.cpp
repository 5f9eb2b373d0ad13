#include "arguments.hpp"

#include "support/temporary_folder.hpp"

#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using place::Settings;
using test_support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;
using enum place::SettingGroup;

Settings parsed(std::vector<std::string> arguments) {
  CLI::App app;
  retrace::Arguments declared(app, false);
  Settings settings;
  declared.settings(settings, {kMotion, kSearch, kGeneral});
  std::ranges::reverse(arguments);
  app.parse(arguments);
  declared.finish();
  return settings;
}

TEST(Arguments, SettingsHoldWhatWasGivenAndNoMore) {
  EXPECT_EQ(parsed({}), Settings{});
  Settings expected;
  expected.motion = "steps";
  expected.sequence_length = 20;
  expected.tie_scale = false;
  EXPECT_EQ(parsed({"--motion", "steps", "--sequence-length=20", "--tie-scale", "false"}), expected);
  expected.motion = "sad";  // the last one counts
  EXPECT_EQ(parsed({"--motion", "steps", "--sequence-length=20", "--tie-scale=false", "--motion=sad"}),
            expected);
}

TEST(Arguments, FlagsComeOnTopOfTheFile) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("a.toml", "motion = \"steps\"\nsequence-length = 5\nfov-deg = 90\n").string();
  const Settings settings = parsed({"--config", file, "--sequence-length", "7"});
  EXPECT_EQ(settings.motion, "steps");
  EXPECT_EQ(settings.sequence_length, 7);
  EXPECT_EQ(settings.fov_deg, 90);  // of a group that the command has no flags for: one file serves all
}

TEST(Arguments, RefuseValuesOutOfRangeAndFlagsOfOtherGroups) {
  EXPECT_THROW_WITH(parsed({"--search-range-rad", "2"}), CLI::ParseError,
                    "--search-range-rad: is '2'; expected 0 to 0.8");
  EXPECT_THROW(parsed({"--fov-deg", "90"}), CLI::ParseError);
}

TEST(Arguments, HelpShowsTheEverydaySettingsAndHelpAllTheRest) {
  for (const bool all : {false, true}) {
    CLI::App app;
    retrace::Arguments declared(app, all);
    Settings settings;
    declared.settings(settings, {kMotion, kSearch, kGeneral});
    declared.footer("Examples");
    const std::string help = app.help();
    EXPECT_THAT(help, HasSubstr("--sequence-length INT=10"));
    EXPECT_THAT(help, HasSubstr("--search {lines,cone,hybrid,graph,path}"));
    if (all) {
      EXPECT_THAT(help, HasSubstr("--uniqueness-window"));
    } else {
      EXPECT_THAT(help, Not(HasSubstr("--uniqueness-window")));
      EXPECT_THAT(help, HasSubstr("--help-all shows every setting."));
    }
  }
}

TEST(Arguments, ExactlyOneOfSeveral) {
  const auto parse = [](std::vector<std::string> arguments) {
    CLI::App app;
    retrace::Arguments declared(app, false);
    std::string a, b;
    declared.exactly_one({declared.option("--a", a, "first"), declared.option("--b", b, "second")});
    std::ranges::reverse(arguments);
    app.parse(arguments);
    return a + b;
  };
  EXPECT_EQ(parse({"--a", "x"}), "x");
  EXPECT_EQ(parse({"--b", "y"}), "y");
  EXPECT_THROW(parse({}), CLI::ParseError);
  EXPECT_THROW(parse({"--a", "x", "--b", "y"}), CLI::ParseError);
}

}  // namespace
