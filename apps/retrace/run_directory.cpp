#include "run_directory.hpp"

#include <cerrno>
#include <string>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>

namespace retrace {
namespace {

namespace fs = std::filesystem;

void check_writable_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw vo::Error(folder.string(), "is no folder", "a folder to write to");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw vo::Error(folder.string(),
                    fmt::format("cannot be written to: {}", std::generic_category().message(errno)),
                    "a writable folder");
  }
}

}  // namespace

void prepare_run_directory(const fs::path& folder, const std::vector<std::string>& files, bool force) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error && !fs::exists(folder)) {
    throw vo::Error(folder.string(), fmt::format("cannot be created: {}", error.message()),
                    "a writable folder");
  }
  check_writable_folder(folder);
  if (force) return;
  for (const std::string& file : files) {
    const fs::path path = folder / file;
    if (fs::exists(path))
      throw vo::Error(path.string(), "already exists", "another folder, or --force to overwrite");
  }
}

void check_writable(const fs::path& file) {
  if (fs::is_directory(file)) throw vo::Error(file.string(), "is a folder", "a file to write");
  check_writable_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

void check_not_swapped(const std::string& walk, const std::string& route) {
  if (!place::looks_like_route(walk) || place::looks_like_route(route)) return;
  throw vo::Error(
      walk, fmt::format("is a route database, given as the walk, and {} none, given as the route", route),
      fmt::format("the two swapped: {} --route {}", route, walk));
}

}  // namespace retrace
