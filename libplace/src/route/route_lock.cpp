#include "place/route/route_lock.hpp"

#include "place/route/route_database.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <stdexcept>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// The lock file: next to the actual file, even if it was named by a link.
fs::path lock_file(const fs::path& route) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(route, error);
  if (error) real = route;
  return real.parent_path() / fmt::format(".{}.lock", real.filename().string());
}

enum class Attempt { kTaken, kBusy, kNoLocks };

Attempt try_lock(int descriptor) {
  for (;;) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Attempt::kTaken;
    if (errno == EWOULDBLOCK) return Attempt::kBusy;
    if (errno != EINTR) return Attempt::kNoLocks;  // ENOLCK, ENOTSUP: network file systems
  }
}

/// True if the open file is still the one with that name: its previous holder may have removed it.
bool is_still(int descriptor, const fs::path& file) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(file.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

/// The holder of the lock, as named in its file.
std::string holder(const fs::path& file) {
  std::array<char, 32> text{};
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return "another program";
  const ssize_t size = ::read(descriptor, text.data(), text.size() - 1);
  ::close(descriptor);
  const std::string process(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return process.empty() ? "another program" : fmt::format("another program (process {})", process);
}

}  // namespace

std::optional<RouteLock::Stamp> RouteLock::stamp(const fs::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return std::nullopt;
  return Stamp{.inode = found.st_ino,
               .size = found.st_size,
               .changed_s = found.st_mtim.tv_sec,
               .changed_ns = found.st_mtim.tv_nsec};
}

RouteLock::RouteLock(const fs::path& route, const RouteLockOptions& options)
    : route_(route), file_(lock_file(route)) {
  if (!(options.wait_s >= 0)) throw std::invalid_argument("RouteLock: wait_s of 0 or more expected");
  const auto deadline = Clock::now() + std::chrono::duration<double>(options.wait_s);
  for (bool said = false;;) {
    const int descriptor = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      throw vo::Error(route.string(),
                      fmt::format("cannot be written: {}", std::generic_category().message(errno)),
                      "a folder that exists and is writable");
    }
    const Attempt attempt = try_lock(descriptor);
    if (attempt == Attempt::kNoLocks || (attempt == Attempt::kTaken && is_still(descriptor, file_))) {
      descriptor_ = descriptor;
      named_.emplace(file_);
      break;
    }
    ::close(descriptor);
    if (attempt == Attempt::kTaken) continue;  // the file was removed in between; there is another
    if (Clock::now() >= deadline) {
      throw vo::Error(route.string(), fmt::format("is being written by {}", holder(file_)),
                      "one at a time; try again when it is done");
    }
    if (!said && options.waiting) options.waiting();
    said = true;
    constexpr auto kPause = std::chrono::milliseconds(50);
    std::this_thread::sleep_for(kPause);
  }
  const std::string process = std::to_string(::getpid());
  if (::ftruncate(descriptor_, 0) != 0 || ::write(descriptor_, process.data(), process.size()) < 0) {
    // Only for others' messages.
  }
  stamp_ = stamp(route_);
}

RouteLock::~RouteLock() {
  // First the name, then the lock: a process that gets the lock of a file without a name tries again.
  named_.reset();
  ::close(descriptor_);
}

void RouteLock::write(const Route& route) const {
  if (stamp(route_) != stamp_)
    throw vo::Error(route_.string(), "was changed by another program meanwhile",
                    "no other writer; do the same again");
  write_route(route_, route);
}

}  // namespace place
