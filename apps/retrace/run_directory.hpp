#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace retrace {

/// Makes sure that results can be written to `folder`: creates it (and its parents) if needed, and refuses,
/// with one clear line, a path that is not a folder, one that cannot be written to, or one that already holds
/// any of `files` unless `force`. Called before any work is done.
void prepare_run_directory(const std::filesystem::path& folder, const std::vector<std::string>& files,
                           bool force);

/// Makes sure that the file can be written: its folder exists and is writable. Called before any work is
/// done.
void check_writable(const std::filesystem::path& file);

/// Throws `vo::Error` where the walk is a route database and the route is none: the two were swapped.
void check_not_swapped(const std::string& walk, const std::string& route);

}  // namespace retrace
