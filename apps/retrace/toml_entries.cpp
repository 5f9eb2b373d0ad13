#include "toml_entries.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

/// A line without its comment. CLI11 takes a # in quotation marks for the beginning of one.
std::string without_comment(const std::string& line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return line.substr(0, i);
    }
  }
  return line;
}

}  // namespace

std::vector<TomlEntry> read_toml(const std::string& file, const std::string& expected) {
  if (!std::filesystem::is_regular_file(file)) throw vo::Error(file, "is no file", expected);
  std::ifstream stream(file);
  if (!stream) throw vo::Error(file, "cannot be read", expected);
  std::vector<TomlEntry> entries;
  try {
    std::stringstream text;
    for (std::string line; std::getline(stream, line);) {
      if (line.find('\0') != std::string::npos)
        throw vo::Error(file, "is no text: it holds zero bytes", expected);
      text << without_comment(line) << '\n';
    }
    CLI::ConfigTOML toml;
    toml.comment('\0');          // they are gone, and what is left of # is not one
    toml.parentSeparator('\0');  // a name of n dots would become n sections of up to n names
    for (const CLI::ConfigItem& item : toml.from_config(text)) {
      if (item.name == "++" || item.name == "--") continue;  // CLI11's marks for the bounds of a section
      entries.push_back({fmt::format("{}", fmt::join(item.parents, ".")), item.name, item.inputs});
    }
  } catch (const CLI::Error& error) {
    throw vo::Error(file, error.what(), "lines of `key = value`");
  }
  return entries;
}

}  // namespace retrace
