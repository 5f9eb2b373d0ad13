#include "toml_entries.hpp"

#include <filesystem>
#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vo/base/error.hpp>

namespace retrace {

std::vector<TomlEntry> read_toml(const std::string& file, const std::string& expected) {
  if (!std::filesystem::is_regular_file(file)) throw vo::Error(file, "is no file", expected);
  std::ifstream stream(file);
  if (!stream) throw vo::Error(file, "cannot be read", expected);
  std::vector<TomlEntry> entries;
  try {
    for (const CLI::ConfigItem& item : CLI::ConfigTOML().from_config(stream)) {
      if (item.name == "++" || item.name == "--") continue;  // CLI11's marks for the bounds of a section
      entries.push_back({fmt::format("{}", fmt::join(item.parents, ".")), item.name, item.inputs});
    }
  } catch (const CLI::Error& error) {
    throw vo::Error(file, error.what(), "lines of `key = value`");
  }
  return entries;
}

}  // namespace retrace
