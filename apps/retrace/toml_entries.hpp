#pragma once

#include <string>
#include <vector>

namespace retrace {

/// A line `key = value` of a TOML file.
struct TomlEntry {
  std::string section;  ///< the name in brackets above it; empty above the first
  std::string key;
  std::vector<std::string> values;  ///< several of a list; CLI11 joins those of a repeated key
};

/// The entries of a file in order. Throws `vo::Error` naming the file if it cannot be read as TOML;
/// `expected`: what it should hold, in words.
std::vector<TomlEntry> read_toml(const std::string& file, const std::string& expected);

}  // namespace retrace
