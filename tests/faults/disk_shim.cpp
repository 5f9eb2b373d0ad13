// Loaded before a program (LD_PRELOAD), stands between it and the disk: counts the operations by which it
// changes files in a folder, and records them, or fails or kills at one of them.
//   DISK_SHIM_FOLDER  the folder; what happens elsewhere is not counted
//   DISK_SHIM_LOG     file to which each operation is appended: see `put`
//   DISK_SHIM_FAIL    from the operation of this number on, writes fail as on a full disk (ENOSPC)
//   DISK_SHIM_SIGNAL  "SIGNAL@NUMBER": the process gets this signal at this operation, then pauses 0.3 s
//
//   DISK_SHIM_KILL    the process is killed (SIGKILL) before the operation of this number
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <sys/uio.h>
#include <unistd.h>

namespace {

template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

const std::string& folder() {
  static const auto& only = *new std::string(variable("DISK_SHIM_FOLDER"));
  return only;
}

long number_of(const char* name) {
  const std::string value = variable(name);
  return value.empty() ? -1 : std::strtol(value.c_str(), nullptr, 10);
}

std::atomic<long> operations = 0;
std::mutex log_mutex;

bool is_inside(const std::string& path) {
  return !folder().empty() && path.starts_with(folder());
}

std::string path_of(int descriptor) {
  std::array<char, 4096> target{};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t size = readlink(link.c_str(), target.data(), target.size());
  return size < 0 ? "" : std::string(target.data(), static_cast<std::size_t>(size));
}

std::string absolute(const char* path) {
  if (path[0] == '/') return path;
  std::array<char, 4096> here{};
  return getcwd(here.data(), here.size()) == nullptr ? path : std::string(here.data()) + "/" + path;
}

/// An operation in the log: its kind, two texts, a number and data, each with its length before it.
void put(char kind, const std::string& first, const std::string& second, long long number, const void* data,
         std::size_t size) {
  static const auto& log = *new std::string(variable("DISK_SHIM_LOG"));  // files change until the very end
  if (log.empty()) return;
  std::string text(1, kind);
  const auto put_number = [&](long long value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const std::string* part : {&first, &second}) {
    put_number(static_cast<long long>(part->size()));
    text += *part;
  }
  put_number(number);
  put_number(static_cast<long long>(size));
  text.append(static_cast<const char*>(data), size);
  const std::scoped_lock lock(log_mutex);
  const int file =
      real<int (*)(const char*, int, ...)>("open")(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  real<ssize_t (*)(int, const void*, std::size_t)>("write")(file, text.data(), text.size());
  real<int (*)(int)>("close")(file);
}

/// Counts an operation; false if it is to fail as on a full disk.
bool may(char kind, const std::string& first, const std::string& second = "", long long number = 0,
         const void* data = "", std::size_t size = 0) {
  static const long fail = number_of("DISK_SHIM_FAIL"), killed = number_of("DISK_SHIM_KILL");
  const long at = operations++;
  static const auto& signalled = *new std::string(variable("DISK_SHIM_SIGNAL"));
  if (const std::size_t sign = signalled.find('@'); sign != std::string::npos) {
    if (at == std::strtol(signalled.c_str() + sign + 1, nullptr, 10)) {
      kill(getpid(), static_cast<int>(std::strtol(signalled.c_str(), nullptr, 10)));
      constexpr useconds_t kMoment_us = 300000;  // for the program to act on it
      usleep(kMoment_us);
    }
  }
  if (at == killed) raise(SIGKILL);
  const bool takes_room = kind == 'W' || kind == 'C' || kind == 'M';
  if (fail >= 0 && at >= fail && takes_room) {
    errno = ENOSPC;
    return false;
  }
  put(kind, first, second, number, data, size);
  return true;
}

int open_counted(const char* name, const char* path, int flags, mode_t mode) {
  const bool changes = (flags & (O_CREAT | O_TRUNC)) != 0 && is_inside(absolute(path));
  if (changes && !may('C', absolute(path), "", flags & O_TRUNC ? 1 : 0)) return -1;
  return real<int (*)(const char*, int, ...)>(name)(path, flags, mode);
}

mode_t mode_of(int flags, va_list arguments) {
  return (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_counted("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  return open_counted("open64", path, flags, mode);
}

ssize_t write(int descriptor, const void* data, std::size_t size) {
  const std::string path = path_of(descriptor);
  if (is_inside(path) && !may('W', path, "", lseek(descriptor, 0, SEEK_CUR), data, size)) return -1;
  return real<ssize_t (*)(int, const void*, std::size_t)>("write")(descriptor, data, size);
}

ssize_t writev(int descriptor, const iovec* parts, int count) {
  const std::string path = path_of(descriptor);
  if (is_inside(path)) {
    std::string all;
    for (int i = 0; i < count; ++i) all.append(static_cast<const char*>(parts[i].iov_base), parts[i].iov_len);
    if (!may('W', path, "", lseek(descriptor, 0, SEEK_CUR), all.data(), all.size())) return -1;
  }
  return real<ssize_t (*)(int, const iovec*, int)>("writev")(descriptor, parts, count);
}

ssize_t pwrite(int descriptor, const void* data, std::size_t size, off_t at) {
  const std::string path = path_of(descriptor);
  if (is_inside(path) && !may('W', path, "", at, data, size)) return -1;
  return real<ssize_t (*)(int, const void*, std::size_t, off_t)>("pwrite")(descriptor, data, size, at);
}

ssize_t pwrite64(int descriptor, const void* data, std::size_t size, off64_t at) {
  const std::string path = path_of(descriptor);
  if (is_inside(path) && !may('W', path, "", at, data, size)) return -1;
  return real<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64")(descriptor, data, size, at);
}

int ftruncate(int descriptor, off_t size) {
  const std::string path = path_of(descriptor);
  if (is_inside(path) && !may('T', path, "", size)) return -1;
  return real<int (*)(int, off_t)>("ftruncate")(descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) {
  const std::string path = path_of(descriptor);
  if (is_inside(path) && !may('T', path, "", size)) return -1;
  return real<int (*)(int, off64_t)>("ftruncate64")(descriptor, size);
}

int fsync(int descriptor) {
  const std::string path = path_of(descriptor);
  if (is_inside(path + "/") && !may('S', path)) return -1;
  return real<int (*)(int)>("fsync")(descriptor);
}

int fdatasync(int descriptor) {
  const std::string path = path_of(descriptor);
  if (is_inside(path + "/") && !may('S', path)) return -1;
  return real<int (*)(int)>("fdatasync")(descriptor);
}

int rename(const char* from, const char* to) {
  if (is_inside(absolute(to)) && !may('R', absolute(from), absolute(to))) return -1;
  return real<int (*)(const char*, const char*)>("rename")(from, to);
}

int mkdir(const char* path, mode_t mode) {
  if (is_inside(absolute(path)) && !may('M', absolute(path))) return -1;
  return real<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

int unlink(const char* path) {
  if (is_inside(absolute(path)) && !may('U', absolute(path))) return -1;
  return real<int (*)(const char*)>("unlink")(path);
}

int remove(const char* path) {
  if (is_inside(absolute(path)) && !may('U', absolute(path))) return -1;
  return real<int (*)(const char*)>("remove")(path);
}
}
