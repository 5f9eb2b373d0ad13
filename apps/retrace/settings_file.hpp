#pragma once

#include <string>

#include <place/settings.hpp>

namespace retrace {

/// Reads a TOML file of settings, `name = value` each. Throws `vo::Error` naming file and key for a file that
/// is not TOML, a key that is not a setting (with the nearest one that is), a repeated key, or a value that
/// the setting does not accept.
place::Settings read_settings_file(const std::string& file);

/// Settings as a TOML file that describes each: those with a value as `name = value`, the others as a comment
/// with their default.
std::string to_toml(const place::Settings& settings);

}  // namespace retrace
