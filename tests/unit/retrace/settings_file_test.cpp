#include "settings_file.hpp"

#include "support/temporary_folder.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using test_support::TemporaryFolder;

TEST(SettingsFile, OfNothingGivenChangesNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(retrace::read_settings_file(folder.write("a.toml", retrace::to_toml({}))), place::Settings{});
}

TEST(SettingsFile, TheCommittedDefaultsAreWhatTheProgramWrites) {
  std::ifstream file(std::string(RETRACE_SOURCE_DIR) + "/configs/default.toml");
  const std::string committed{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(committed, retrace::to_toml({})) << "renew it: retrace config -o configs/default.toml";
}

TEST(SettingsFile, ReadsBackWhatIsGiven) {
  const TemporaryFolder folder;
  place::Settings settings;
  settings.motion = "file";
  settings.motion_file = "C:\\walks\\a \"b\".tum";
  settings.sampling_n = 0.1 + 0.2;
  settings.tie_scale = false;
  settings.every = 3;
  settings.accept_score = -1.5;
  EXPECT_EQ(retrace::read_settings_file(folder.write("a.toml", retrace::to_toml(settings))), settings);
}

TEST(SettingsFile, ANumberSignInQuotesIsNoComment) {
  const TemporaryFolder folder;
  place::Settings settings;
  settings.camera = "cam #2.yml";
  EXPECT_EQ(retrace::read_settings_file(folder.write("a.toml", retrace::to_toml(settings))), settings);
  settings = {};
  settings.motion = "sad";
  settings.every = 3;
  EXPECT_EQ(retrace::read_settings_file(
                folder.write("b.toml", "# of 'a walk\nmotion = \"sad\" # why \"not\"\nevery = 3 # it's\n")),
            settings);
}

TEST(SettingsFile, NamesFileAndKey) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* text, const char* said) {
    EXPECT_THROW_WITH(retrace::read_settings_file(folder.write("a.toml", text)), vo::Error, said);
  };
  refused("samplin-n = 3\n", "a.toml: samplin-n: is no setting; expected sampling-n?");
  refused("sampling-n = \"many\"\n", "a.toml: sampling-n: is 'many'; expected a number");
  refused("every = 0\n", "a.toml: every: is '0'; expected 1 to 1000000");
  refused("every = 1\nevery = 2\n", "a.toml: every: stands there twice");
  refused("[search]\nevery = 1\n", "a.toml: search.every: is no setting");
  EXPECT_THROW_WITH(retrace::read_settings_file((folder / "none.toml").string()), vo::Error,
                    "none.toml: is no file");
}

}  // namespace
