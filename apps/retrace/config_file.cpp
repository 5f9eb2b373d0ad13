#include "config_file.hpp"

#include "settings.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

/// Levenshtein's distance.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::vector<CLI::ConfigItem> parse_toml(const std::string& file) {
  if (!std::filesystem::is_regular_file(file)) throw vo::Error(file, "is no file", "a TOML file of settings");
  std::ifstream stream(file);
  if (!stream) throw vo::Error(file, "cannot be read", "a TOML file of settings");
  try {
    return CLI::ConfigTOML().from_config(stream);
  } catch (const CLI::Error& error) {
    throw vo::Error(file, error.what(), "lines of `key = value`");
  }
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t fewest = name.size() / 2 + 1;
  for (const std::string& candidate : candidates) {
    if (const std::size_t count = edits(name, candidate); count < fewest) {
      fewest = count;
      nearest = candidate;
    }
  }
  return nearest;
}

std::vector<std::string> arguments_from_config(const std::string& file, const CLI::App& command) {
  std::vector<std::string> known;
  for (const SettingEntry& entry : entries({})) known.push_back(entry.name);

  std::vector<std::string> arguments;
  std::set<std::string> seen;
  for (const CLI::ConfigItem& item : parse_toml(file)) {
    if (item.name == "++" || item.name == "--") continue;  // CLI11's marks for the begin and end of a section
    const std::string key = item.fullname();
    if (std::ranges::find(known, key) == known.end()) {
      const std::string nearest = nearest_name(item.name, known);
      throw vo::Error(
          file, fmt::format("has an unknown key '{}'", key),
          nearest.empty() ? "one of those in configs/default.toml" : fmt::format("'{}'?", nearest));
    }
    // CLI11 puts the values of a repeated key together.
    if (!seen.insert(key).second || item.inputs.size() > 1) {
      throw vo::Error(file, fmt::format("has the key '{}' twice, or several values for it", key),
                      "one value, once");
    }
    if (item.inputs.empty())
      throw vo::Error(file, fmt::format("has no value for the key '{}'", key), "one value");

    // Tried on an app of its own, so that the message names the file and the key.
    Settings scratch;
    CLI::App trial;
    add_all_options(trial, scratch);
    std::string argument = fmt::format("--{}={}", key, item.inputs.front());
    try {
      trial.parse(std::vector<std::string>{argument});
    } catch (const CLI::ParseError& error) {
      throw vo::Error(fmt::format("{}: {}", file, key), error.what());
    }
    if (command.get_option_no_throw("--" + key) != nullptr) arguments.push_back(std::move(argument));
  }
  return arguments;
}

}  // namespace retrace
