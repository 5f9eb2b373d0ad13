#pragma once

#include "vo/io/partial_path.hpp"

#include <filesystem>
#include <string_view>

namespace vo {

/// A file that appears whole or not at all: it is written under a temporary name beside its own, and `commit`
/// flushes it to the disk and renames it. Without `commit` the destructor removes the temporary; what was at
/// `path` before stays.
class AtomicFile {
 public:
  /// Does not open anything yet. The temporary's name holds the process id, so two writers do not mix.
  explicit AtomicFile(std::filesystem::path path);

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_.path(); }

  /// Flushes and renames. Throws `vo::Error` naming the path and the system's reason.
  void commit();

 private:
  std::filesystem::path path_;
  PartialPath temporary_;
};

/// The name under which this process writes a file or folder until it is whole: hidden, beside its own, with
/// the process id, so that two writers do not mix.
std::filesystem::path partial_name(const std::filesystem::path& path);

/// Removes what processes that were killed while they wrote `path` left beside it: partial names of processes
/// that no longer run. For one writer at a time, as under a lock. O(files in the folder).
void remove_abandoned(const std::filesystem::path& path);

/// Writes `content` to `path`, whole or not at all, over what is there. Throws `vo::Error` naming the path
/// and the system's reason (no such folder, read-only, disk full).
void write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace vo
