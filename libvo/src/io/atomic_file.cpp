#include "vo/io/atomic_file.hpp"

#include "vo/base/error.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fcntl.h>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace vo {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw Error(path.string(), fmt::format("cannot be written: {}", std::generic_category().message(error)),
              "a folder that exists, is writable and has room");
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// The beginning of a temporary's name; the process id follows. With the host, as in a shared folder a number
/// may be that of another machine's process.
std::string beginning(const fs::path& path) {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format(".{}.partial-{}-", path.filename().string(), host.data());
}

}  // namespace

fs::path partial_name(const fs::path& path) {
  return folder_of(path) / (beginning(path) + std::to_string(::getpid()));
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), temporary_(partial_name(path_)) {}

void remove_abandoned(const fs::path& path) {
  const std::string begin = beginning(path);
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(path), ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin)) continue;
    pid_t process = 0;
    const auto [end, error] = std::from_chars(name.data() + begin.size(), name.data() + name.size(), process);
    if (error != std::errc() || end != name.data() + name.size() || process <= 0) continue;
    if (process == ::getpid() || (::kill(process, 0) != 0 && errno == ESRCH))
      fs::remove_all(entry.path(), ignored);
  }
}

void AtomicFile::commit() {
  const Descriptor file(::open(temporary().c_str(), O_RDWR | O_CLOEXEC));
  if (file.get() < 0 || ::fsync(file.get()) != 0) fail(path_, errno);
  if (const int error = temporary_.rename_to(path_); error != 0) fail(path_, error);
  // The rename itself becomes durable with the folder; a folder that cannot be flushed is no reason to fail.
  const Descriptor folder(::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() >= 0) ::fsync(folder.get());
}

void write_file(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  {
    const Descriptor out(::open(file.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (out.get() < 0) fail(path, errno);
    while (!content.empty()) {
      const ssize_t written = ::write(out.get(), content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(path, errno);
      content.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  file.commit();
}

}  // namespace vo
