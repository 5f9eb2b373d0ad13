#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vo/io/partial_path.hpp>

namespace retrace {

/// Makes sure that results can be written to `folder`: creates it (and its parents) if needed, to be removed
/// again at the end of the program if nothing is written to it, and refuses,
/// with one clear line, a path that is not a folder, one that cannot be written to, or one that already holds
/// any of `files` unless `force`. Called before any work is done.
void prepare_run_directory(const std::filesystem::path& folder, const std::vector<std::string>& files,
                           bool force);

/// The files of a run, all of them or none (a kill while they are moved leaves whole files, some of them
/// new): they are written to a hidden folder within the run's, and moved from there when all are whole.
/// Without `commit` they are removed, and what was in the run's folder stays.
class StagedFiles {
 public:
  /// Throws `vo::Error` naming the folder if nothing can be written to it.
  explicit StagedFiles(std::filesystem::path folder);

  /// Where to write.
  [[nodiscard]] const std::filesystem::path& path() const { return staged_.path(); }

  /// Moves the files into the run's folder, over what is there. Of `stale`, names of files that this run may
  /// have and an earlier one had, those not written are removed. Throws `vo::Error` naming the file.
  void commit(const std::vector<std::string>& stale = {});

 private:
  std::filesystem::path folder_;
  vo::PartialPath staged_;
};

/// Makes sure that the file can be written: its folder exists and is writable. Called before any work is
/// done.
void check_writable(const std::filesystem::path& file);

/// The same for a file that is not to be there yet, unless `force`. `otherwise`: what else the user may give,
/// as "another name".
void check_new_file(const std::filesystem::path& file, bool force, const std::string& otherwise);

/// Throws `vo::Error` unless the folder is there, saying which command of `retrace` writes such a one.
void check_written_by(const std::string& command, const std::filesystem::path& folder);

/// Throws `vo::Error` where the walk is a route database and the route is none: the two were swapped.
void check_not_swapped(const std::string& walk, const std::string& route);

}  // namespace retrace
