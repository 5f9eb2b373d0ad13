#include "vo/io/partial_path.hpp"

#include "vo/base/error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

namespace vo {
namespace {

namespace fs = std::filesystem;

struct PartialEntry {
  fs::path path;
  Removal removal;
};

struct PartialRegistry {
  std::mutex mutex;
  std::vector<PartialEntry> entries;  ///< in order of creation
};

PartialRegistry& partial_registry() {
  static auto& only = *new PartialRegistry;  // objects may outlive the statics
  return only;
}

void remove_partial(const PartialEntry& entry) {
  std::error_code ignored;
  if (entry.removal == Removal::kAll) {
    fs::remove_all(entry.path, ignored);
  } else {
    fs::remove(entry.path, ignored);
  }
}

void forget(std::vector<PartialEntry>& entries, const fs::path& path) {
  std::erase_if(entries, [&](const PartialEntry& entry) { return entry.path == path; });
}

}  // namespace

PartialPath::PartialPath(fs::path path, Removal removal) : path_(std::move(path)) {
  const std::scoped_lock lock(partial_registry().mutex);
  partial_registry().entries.push_back({path_, removal});
}

PartialPath::~PartialPath() {
  const std::scoped_lock lock(partial_registry().mutex);
  std::vector<PartialEntry>& entries = partial_registry().entries;
  for (const PartialEntry& entry : entries)
    if (entry.path == path_) remove_partial(entry);
  forget(entries, path_);
}

int PartialPath::rename_to(const fs::path& name) {
  const std::scoped_lock lock(partial_registry().mutex);
  if (std::rename(path_.c_str(), name.c_str()) != 0) return errno;
  forget(partial_registry().entries, path_);
  return 0;
}

void PartialPath::release_into(const fs::path& folder, const std::vector<std::string>& stale) {
  const std::scoped_lock lock(partial_registry().mutex);
  std::error_code error;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_, error)) files.push_back(entry.path());
  if (error) throw Error(folder.string(), "cannot be written to: " + error.message());
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const fs::path to = folder / file.filename();
    if (std::rename(file.c_str(), to.c_str()) != 0)
      throw Error(to.string(), "cannot be written: " + std::generic_category().message(errno));
  }
  for (const std::string& name : stale) {
    const bool written = std::ranges::any_of(files, [&](const fs::path& f) { return f.filename() == name; });
    if (!written) fs::remove(folder / name, error);
  }
}

void discard_partial_paths() {
  partial_registry().mutex.lock();  // for good
  std::vector<PartialEntry>& entries = partial_registry().entries;
  while (!entries.empty()) {
    remove_partial(entries.back());  // what a folder holds was made after it
    entries.pop_back();
  }
}

}  // namespace vo
