#include "support/temporary_folder.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/settings.hpp>
#include <vo/base/error.hpp>

namespace {

using place::Setting;
using place::Settings;

/// The names that a condition asks for, and whether it asks only if they are given.
std::vector<std::pair<std::string, bool>> asked_for(std::string_view when) {
  std::vector<std::pair<std::string, bool>> names;
  std::string all(when);
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = std::min(all.find('&', begin), all.size());
    std::string one = all.substr(begin, end - begin);
    const bool given = one.front() == '!';
    if (given) one.erase(0, 1);
    names.emplace_back(one.substr(0, one.find_first_of("!=")), given);
    begin = end + 1;
  }
  return names;
}

TEST(SettingsTable, HasEveryNameAndFieldOnce) {
  std::set<std::string_view> names;
  Settings settings;
  std::size_t set_before = 0;
  for (const Setting& setting : place::settings_table()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    // A field of its own: setting it changes no other.
    EXPECT_FALSE(place::text_of(settings, setting)) << setting.name;
    const std::string choice(setting.choices.substr(0, setting.choices.find('|')));
    const bool number = setting.most > setting.least;
    const std::string any =
        !choice.empty()               ? choice
        : setting.standard == "true"  ? "false"
        : setting.standard == "false" ? "true"
        : number ? std::to_string(static_cast<int>(std::min(setting.most, std::max(1.0, setting.least))))
                 : "text";
    place::set(settings, setting, any);
    std::size_t with_value = 0;
    for (const Setting& other : place::settings_table())
      with_value += place::text_of(settings, other) ? 1 : 0;
    EXPECT_EQ(with_value, ++set_before) << setting.name;
  }
}

TEST(SettingsTable, DefaultsAreInRange) {
  Settings settings;
  for (const Setting& setting : place::settings_table()) {
    if (setting.standard.empty()) continue;
    EXPECT_NO_THROW(place::set(settings, setting, setting.standard)) << setting.name;
    EXPECT_EQ(place::text_of(settings, setting), std::string(setting.standard)) << setting.name;
  }
  EXPECT_NO_THROW(place::check_ranges(settings));
}

TEST(SettingsTable, ConditionsAskForSettingsThatStandBefore) {
  std::set<std::string> before;
  for (const Setting& setting : place::settings_table()) {
    for (const auto& [name, only_given] : asked_for(setting.when))
      EXPECT_TRUE(before.contains(name)) << setting.name << " asks for " << name;
    before.emplace(setting.name);
  }
}

TEST(SettingsTable, GroupsStandTogetherAndEverydaySettingsAreFew) {
  std::set<place::SettingGroup> ended;
  std::optional<place::SettingGroup> group;
  int everyday = 0;
  for (const Setting& setting : place::settings_table()) {
    if (group && *group != setting.group) ended.insert(*group);
    group = setting.group;
    EXPECT_FALSE(ended.contains(setting.group)) << setting.name;
    everyday += setting.everyday ? 1 : 0;
    EXPECT_FALSE(setting.description.empty()) << setting.name;
  }
  EXPECT_LE(everyday, 18);
}

TEST(Settings, SayWhatWasWrong) {
  Settings settings;
  const auto refused = [&](const char* name, const char* text, const char* said) {
    EXPECT_THROW_WITH(place::set(settings, place::setting_named(name), text), vo::Error, said);
  };
  refused("every", "0", "every: is '0'; expected 1 to 1000000");
  refused("every", "2.5", "every: is '2.5'; expected a whole number");
  refused("every", "", "every: is ''; expected a whole number");
  refused("spacing-m", "0", "spacing-m: is '0'; expected a number above 0");
  refused("spacing-m", "nan", "spacing-m: is 'nan'; expected a number above 0");
  refused("spacing-m", "inf", "spacing-m");
  refused("tie-scale", "yes", "tie-scale: is 'yes'; expected true or false");
  refused("motion", "sads", "motion: is 'sads'; expected one of auto, sad, steps");
  refused("motion", "sad|steps", "motion: is 'sad|steps'");
  refused("motion-file", "", "motion-file: is ''; expected a value");
  EXPECT_EQ(settings, Settings{});
  EXPECT_THROW_WITH(place::setting_named("samplin-n"), vo::Error,
                    "samplin-n: is no setting; expected sampling-n?");
  EXPECT_THROW_WITH(place::setting_named("xyz"), vo::Error, "a name of configs/default.toml");
}

TEST(Settings, TextsReadBackTheSame) {
  Settings settings, again;
  settings.every = 7;
  settings.sampling_n = 0.1 + 0.2;  // 17 digits
  settings.tie_scale = false;
  settings.motion_file = "a b\"c.tum";
  settings.accept_score = -1e-9;
  for (const Setting& setting : place::settings_table()) {
    if (const auto text = place::text_of(settings, setting)) place::set(again, setting, *text);
  }
  EXPECT_EQ(again, settings);
}

TEST(Settings, ValuesGivenInCodeAreChecked) {
  Settings settings;
  settings.search_range_rad = 0.8;
  EXPECT_NO_THROW(place::check_ranges(settings));
  settings.search_range_rad = 0.81;
  EXPECT_THROW_WITH(place::check_ranges(settings), vo::Error,
                    "search-range-rad: is '0.81'; expected 0 to 0.8");
  settings = {};
  settings.motion = "walking";
  EXPECT_THROW_WITH(place::check_ranges(settings), vo::Error, "motion: is 'walking'");
}

TEST(Settings, MergedTakesWhatIsGivenFirst) {
  Settings given, otherwise;
  given.every = 2;
  otherwise.every = 3;
  otherwise.threads = 4;
  const Settings both = place::merged(given, otherwise);
  EXPECT_EQ(both.every, 2);
  EXPECT_EQ(both.threads, 4);
  EXPECT_FALSE(both.motion);
}

TEST(Settings, ConditionsHoldOrSayWhyNot) {
  Settings settings;
  const auto holds = [&](const char* when, std::string* why_not = nullptr) {
    return place::has_effect(settings, Setting{.name = "any", .field = &Settings::every, .when = when},
                             why_not);
  };
  EXPECT_TRUE(holds(""));
  EXPECT_FALSE(holds("motion=sad|steps"));  // has no value
  EXPECT_TRUE(holds("motion!=sad|steps"));
  settings.motion = "steps";
  EXPECT_TRUE(holds("motion=sad|steps"));
  EXPECT_FALSE(holds("motion!=sad|steps"));
  EXPECT_TRUE(holds("motion=steps&!camera"));
  settings.camera = "c.yaml";
  std::string why_not;
  EXPECT_FALSE(holds("motion=steps&!camera", &why_not));
  EXPECT_EQ(why_not, "camera is given");
  EXPECT_FALSE(holds("motion=none&!camera", &why_not));
  EXPECT_EQ(why_not, "motion is steps");
}

TEST(Settings, RefuseTextThatNoFileOfSettingsHolds) {
  place::Settings settings;
  for (const std::string& text : {std::string("a\0b", 3), std::string("a\nb"), std::string("\x7F")})
    EXPECT_THROW(place::set(settings, place::setting_named("motion-file"), text), vo::Error);
  place::set(settings, place::setting_named("motion-file"), "caf\xC3\xA9 \"1\".tum");
  EXPECT_EQ(settings.motion_file, "caf\xC3\xA9 \"1\".tum");
}

}  // namespace
