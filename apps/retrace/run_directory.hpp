#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace retrace {

/// Makes sure that results can go to `folder`: creates it (and its parents) where there is none, and refuses,
/// with one clear line, a path that is no folder, one that cannot be written to, or one that already holds
/// any of `files` unless `force`. Called before any work is done.
void prepare_run_directory(const std::filesystem::path& folder, const std::vector<std::string>& files,
                           bool force);

/// Makes sure that the file can be written: its folder exists and is writable. Called before any work is
/// done.
void check_writable(const std::filesystem::path& file);

}  // namespace retrace
