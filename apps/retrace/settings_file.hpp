#pragma once

#include <string>

#include <place/settings.hpp>

namespace retrace {

/// Reads a TOML file of settings, `name = value` each. Throws `vo::Error` naming file and key for a file that
/// is no TOML, a key that is no setting (with the nearest that is), one that stands twice, or a value that
/// the setting does not take.
place::Settings read_settings_file(const std::string& file);

/// Settings as a TOML file that says what each is: those with a value as `name = value`, the others as a
/// comment with their default.
std::string to_toml(const place::Settings& settings);

}  // namespace retrace
