#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace place {

/// Settings of `RouteLock`.
struct RouteLockOptions {
  double wait_s = 30;             ///< how long to wait for another writer
  std::function<void()> waiting;  ///< called once, when it begins to wait
};

/// The right to change a route's file, for one writer at a time, of this process or another: from before the
/// route is read until it is written, so that of two walks added at once neither is lost.
///
/// It is a lock of the system's on a hidden file beside the route (`flock` on `.route.db.lock`), which ends
/// with the process that holds it, however that ends; the file is removed with the lock, and one that a dead
/// process left behind stops nobody. On file systems without locks there is still `check_unchanged`. Readers
/// need none: a route's file is replaced whole.
class RouteLock {
 public:
  /// Waits for the lock. Throws `vo::Error` naming the route if another writer keeps it, or the folder cannot
  /// be written; `std::invalid_argument` for a wait below 0.
  explicit RouteLock(const std::filesystem::path& route, const RouteLockOptions& options = {});
  ~RouteLock();
  RouteLock(const RouteLock&) = delete;
  RouteLock& operator=(const RouteLock&) = delete;

  /// Throws `vo::Error` if the route's file is another one than when the lock was taken: a program that knows
  /// nothing of the lock, or a file system without locks. To be called right before writing.
  void check_unchanged() const;

 private:
  /// What tells a file from what replaced it.
  struct Stamp {
    std::uint64_t inode = 0;
    std::int64_t size = 0, changed_s = 0, changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };
  static std::optional<Stamp> stamp(const std::filesystem::path& file);

  std::filesystem::path route_;
  std::filesystem::path file_;  ///< the lock's
  int descriptor_ = -1;
  std::optional<Stamp> stamp_;
};

}  // namespace place
