#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vo {

/// How much of a partial path is removed.
enum class Removal {
  kAll,     ///< the file, or the folder with what is in it
  kIfEmpty  ///< the folder, unless something is in it
};

/// A file or folder that exists only while something is being written: removed at the end of the object's
/// life unless it was given its final name. All those of the process are known, so that a program which is
/// told to end (SIGINT, SIGTERM) can remove them first (`discard_partial_paths`).
class PartialPath {
 public:
  explicit PartialPath(std::filesystem::path path, Removal removal = Removal::kAll);
  ~PartialPath();
  PartialPath(const PartialPath&) = delete;
  PartialPath& operator=(const PartialPath&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Renames it to its final name; what had that name is replaced. Returns 0, or the system's error, and then
  /// the path is still partial.
  int rename_to(const std::filesystem::path& name);

  /// For a folder: moves what it holds into another folder, over what is there, and removes those files
  /// called `stale` there that it does not hold, all before the program can be told to end. Throws
  /// `vo::Error` naming the file that cannot be moved.
  void release_into(const std::filesystem::path& folder, const std::vector<std::string>& stale = {});

 private:
  std::filesystem::path path_;
};

/// Removes all partial paths of the process. For a program that ends right afterwards without returning:
/// other threads that would rename or remove one wait for ever. Not to be called from a signal handler.
void discard_partial_paths();

}  // namespace vo
