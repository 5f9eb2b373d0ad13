#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace retrace {

/// Reads a flat TOML file of settings and gives it as command-line arguments, `--key=value`, of those that
/// `command` has; settings of other commands are passed over, so one file serves all. Throws `vo::Error`
/// naming file and key for a file that is no TOML, a key that no command knows (with the nearest that one
/// does), one that stands twice, or a value that its option does not take.
std::vector<std::string> arguments_from_config(const std::string& file, const CLI::App& command);

/// The candidate that takes the fewest edits to make of `name`; empty if even that takes more than half its
/// letters.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace retrace
