#include "settings_file.hpp"

#include "toml_entries.hpp"

#include <set>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

/// The value in TOML: texts in quotation marks, with the necessary escapes.
std::string quoted(const place::Setting& setting, const std::string& value) {
  if (!std::holds_alternative<std::optional<std::string> place::Settings::*>(setting.field)) return value;
  const bool plain = value.find_first_of("\"\\") == std::string::npos;
  return plain ? fmt::format("\"{}\"", value) : fmt::format("'{}'", value);
}

}  // namespace

place::Settings read_settings_file(const std::string& file) {
  place::Settings settings;
  std::set<std::string> seen;
  for (const TomlEntry& item : read_toml(file, "a TOML file of settings")) {
    const std::string key = item.section.empty() ? item.key : item.section + "." + item.key;
    try {
      const place::Setting& setting = place::setting_named(key);
      // CLI11 joins the values of a repeated key.
      if (!seen.insert(key).second || item.values.size() > 1)
        throw vo::Error(key, "stands there twice, or with several values", "one value, once");
      if (item.values.empty()) throw vo::Error(key, "has no value", "one value");
      place::set(settings, setting, item.values.front());
    } catch (const vo::Error& error) {
      throw vo::Error(file, error.what());
    }
  }
  return settings;
}

std::string to_toml(const place::Settings& settings) {
  std::string text = "# Settings of retrace, for --config; flags on the command line come first.\n";
  std::string_view group;
  for (const place::Setting& setting : place::settings_table()) {
    if (place::name_of(setting.group) != group)
      text += fmt::format("\n# ---- {} ----\n", place::name_of(setting.group));
    group = place::name_of(setting.group);
    const std::optional<std::string> value = place::text_of(settings, setting);
    text += fmt::format("\n# {}\n", setting.description);
    if (value) {
      text += fmt::format("{} = {}\n", setting.name, quoted(setting, *value));
    } else {
      const std::string standard(setting.standard);
      text +=
          fmt::format("# {} ={}\n", setting.name, standard.empty() ? "" : " " + quoted(setting, standard));
    }
  }
  return text;
}

}  // namespace retrace
