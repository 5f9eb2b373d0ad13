#pragma once

#include "report/page.hpp"

#include <filesystem>

namespace retrace {

/// The settings of a saved configuration (see settings_file.hpp), under a heading; nothing if there is no
/// such file.
void put_settings(Page& page, const std::filesystem::path& config);

}  // namespace retrace
