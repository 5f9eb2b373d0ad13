#pragma once

#include "place/route/route.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include <vo/io/partial_path.hpp>

namespace place {

/// Settings of `RouteLock`.
struct RouteLockOptions {
  double wait_s = 30;             ///< how long to wait for another writer
  std::function<void()> waiting;  ///< called once, when waiting begins
};

/// The right to change a route's file, for one writer at a time, in this process or another: held from before
/// the route is read until it is written, so that two walks added at the same time are both kept.
///
/// It is a system lock on a hidden file next to the route (`flock` on `.route.db.lock`), which is released
/// when the process that holds it ends in any way; the file is removed with the lock, and one left behind by
/// a dead process blocks nobody. On file systems without locks, `write` still notices the other. Readers
/// need no lock: a route's file is replaced whole.
class RouteLock {
 public:
  /// Waits for the lock. Throws `vo::Error` naming the route if another writer keeps it or the folder cannot
  /// be written; `std::invalid_argument` for a wait below 0.
  explicit RouteLock(const std::filesystem::path& route, const RouteLockOptions& options = {});
  ~RouteLock();
  RouteLock(const RouteLock&) = delete;
  RouteLock& operator=(const RouteLock&) = delete;

  /// Writes the route (`write_route`), once. Throws `vo::Error` if its file was replaced since the lock was
  /// taken, by a program that ignores the lock or on a file system without locks.
  void write(const Route& route) const;

 private:
  /// Distinguishes a file from its replacement.
  struct Stamp {
    std::uint64_t inode = 0;
    std::int64_t size = 0, changed_s = 0, changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  static std::optional<Stamp> stamp(const std::filesystem::path& file);

  std::filesystem::path route_;
  std::filesystem::path file_;            ///< the lock file
  std::optional<vo::PartialPath> named_;  ///< the lock file's name, which goes with the lock
  int descriptor_ = -1;
  std::optional<Stamp> stamp_;
};

}  // namespace place
