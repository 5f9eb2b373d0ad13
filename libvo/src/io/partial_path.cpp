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

struct Entry {
  fs::path path;
  Removal removal;
};

struct Registry {
  std::mutex mutex;
  std::vector<Entry> entries;  ///< in order of creation
};

Registry& registry() {
  static auto& only = *new Registry;  // objects may outlive the statics
  return only;
}

void remove(const Entry& entry) {
  std::error_code ignored;
  if (entry.removal == Removal::kAll) {
    fs::remove_all(entry.path, ignored);
  } else {
    fs::remove(entry.path, ignored);
  }
}

void forget(std::vector<Entry>& entries, const fs::path& path) {
  std::erase_if(entries, [&](const Entry& entry) { return entry.path == path; });
}

}  // namespace

PartialPath::PartialPath(fs::path path, Removal removal) : path_(std::move(path)) {
  const std::scoped_lock lock(registry().mutex);
  registry().entries.push_back({path_, removal});
}

PartialPath::~PartialPath() {
  const std::scoped_lock lock(registry().mutex);
  std::vector<Entry>& entries = registry().entries;
  for (const Entry& entry : entries)
    if (entry.path == path_) remove(entry);
  forget(entries, path_);
}

int PartialPath::rename_to(const fs::path& name) {
  const std::scoped_lock lock(registry().mutex);
  if (std::rename(path_.c_str(), name.c_str()) != 0) return errno;
  forget(registry().entries, path_);
  return 0;
}

void PartialPath::release_into(const fs::path& folder) {
  const std::scoped_lock lock(registry().mutex);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const fs::path to = folder / file.filename();
    if (std::rename(file.c_str(), to.c_str()) != 0)
      throw Error(to.string(), "cannot be written: " + std::generic_category().message(errno));
  }
}

void discard_partial_paths() {
  registry().mutex.lock();  // for good
  std::vector<Entry>& entries = registry().entries;
  while (!entries.empty()) {
    remove(entries.back());  // what a folder holds was made after it
    entries.pop_back();
  }
}

}  // namespace vo
