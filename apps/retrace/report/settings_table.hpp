#pragma once

#include "report/page.hpp"

#include <filesystem>
#include <string>

namespace retrace {

/// The settings of a saved configuration (see settings_file.hpp), under a heading; nothing if there is no
/// such file.
void put_settings(Page& page, const std::filesystem::path& config);
/// The same for the contents of such a file.
void put_settings(Page& page, const std::string& toml);

}  // namespace retrace
