#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace test_support {

/// The folder of recordings and golden outputs that are no part of the project: the environment's
/// RETRACE_DATA, or `shared/data` beside the source tree. None where there is no such folder; tests then skip
/// themselves visibly.
inline std::optional<std::filesystem::path> data_folder() {
  namespace fs = std::filesystem;
  const char* given = std::getenv("RETRACE_DATA");
  const fs::path folder =
      given != nullptr ? fs::path(given) : fs::path(RETRACE_SOURCE_DIR) / ".." / "shared" / "data";
  std::error_code error;
  if (!fs::is_directory(folder, error)) return std::nullopt;
  return fs::canonical(folder);
}

/// The golden outputs, beside the data folder.
inline std::optional<std::filesystem::path> golden_folder() {
  const auto data = data_folder();
  if (!data || !std::filesystem::is_directory(data->parent_path() / "golden")) return std::nullopt;
  return data->parent_path() / "golden";
}

}  // namespace test_support
