#include "run_directory.hpp"

#include <cerrno>
#include <deque>
#include <ranges>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>
#include <vo/io/atomic_file.hpp>

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
  static std::deque<vo::PartialPath> created;  // those that stay empty go when the program ends
  std::error_code error;
  std::vector<fs::path> missing;  // the innermost first
  for (fs::path at = folder.has_filename() ? folder : folder.parent_path();
       !at.empty() && !fs::exists(at, error); at = at.parent_path())
    missing.push_back(at);
  for (const fs::path& made : missing | std::views::reverse)
    created.emplace_back(made, vo::Removal::kIfEmpty);
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

StagedFiles::StagedFiles(fs::path folder)
    : folder_(std::move(folder)), staged_(vo::partial_name(folder_ / "run")) {
  vo::remove_abandoned(folder_ / "run");
  std::error_code error;
  if (!fs::create_directory(staged_.path(), error)) {
    throw vo::Error(folder_.string(), fmt::format("cannot be written to: {}", error.message()),
                    "a writable folder with room");
  }
}

void StagedFiles::commit(const std::vector<std::string>& stale) {
  staged_.release_into(folder_, stale);
}

void check_writable(const fs::path& file) {
  if (fs::is_directory(file)) throw vo::Error(file.string(), "is a folder", "a file to write");
  check_writable_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

void check_new_file(const fs::path& file, bool force, const std::string& otherwise) {
  check_writable(file);
  if (!force && fs::exists(file))
    throw vo::Error(file.string(), "already exists", otherwise + ", or --force to overwrite");
}

void check_written_by(const std::string& command, const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw vo::Error(folder.string(), "is no folder", fmt::format("one written by `retrace {}`", command));
}

void check_not_swapped(const std::string& walk, const std::string& route) {
  if (!place::looks_like_route(walk) || place::looks_like_route(route)) return;
  throw vo::Error(
      walk, fmt::format("is a route database, given as the walk, and {} none, given as the route", route),
      fmt::format("the two swapped: {} --route {}", route, walk));
}

}  // namespace retrace
