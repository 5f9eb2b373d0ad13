#include "fuzz.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sanitizer/allocator_interface.h>
#include <unistd.h>

#include <vo/base/error.hpp>

namespace fuzz {
namespace {

namespace fs = std::filesystem;

/// Bytes that are allocated, of what was since the count began.
struct Memory {
  bool counted = false;
  std::ptrdiff_t now = 0, most = 0;
};
Memory memory;

void taken(const volatile void* block, std::size_t) {
  if (!memory.counted) return;
  memory.now += static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(block));
  memory.most = std::max(memory.most, memory.now);
}

void given_back(const volatile void* block) {
  if (memory.counted && block != nullptr)
    memory.now -= static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(block));
}

[[noreturn]] void finding(const std::string& what) {
  std::fprintf(stderr, "FINDING: %s\n", what.c_str());
  std::abort();
}

struct Folder {
  fs::path path;
  Folder() {
    const fs::path shm = "/dev/shm";
    const char* const given = std::getenv("RETRACE_FUZZ_FOLDER");
    path = (given != nullptr  ? fs::path(given)
            : fs::exists(shm) ? shm
                              : fs::temp_directory_path()) /
           ("retrace-fuzz-" + std::to_string(::getpid()));
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

const fs::path& folder() {
  static const Folder own;
  return own.path;
}

fs::path write(std::string_view name, Bytes bytes) {
  fs::path path = folder() / name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return path;
}

std::vector<Bytes> parts(Bytes input, std::size_t count) {
  constexpr std::string_view kBetween = "%%\n";
  std::vector<Bytes> all;
  while (all.size() + 1 < count) {
    const auto found = std::search(input.begin(), input.end(), kBetween.begin(), kBetween.end());
    const auto length = static_cast<std::size_t>(found - input.begin());
    all.push_back(input.first(length));
    input = input.subspan(std::min(length + kBetween.size(), input.size()));
  }
  all.push_back(input);
  return all;
}

void call(std::size_t input_bytes, const std::function<void()>& reader, std::size_t allowance) {
  static const int hooked = __sanitizer_install_malloc_and_free_hooks(taken, given_back);
  if (hooked == 0) finding("memory cannot be counted");
  constexpr std::size_t kMost = 50;  // times the file
  const std::size_t limit = kMost * input_bytes + allowance;
  memory = {.counted = true};
  try {
    reader();
  } catch (const vo::Error& error) {
    const std::string_view text = error.what();
    if (text.empty() || text.find('\n') != std::string_view::npos) finding("a message that is not one line");
  } catch (const std::exception& error) {
    finding(std::string("an exception that is no vo::Error: ") + error.what());
  }
  memory.counted = false;
  if (memory.most > static_cast<std::ptrdiff_t>(limit)) {
    finding(std::to_string(memory.most) + " bytes of memory for a file of " + std::to_string(input_bytes));
  }
}

void call_one(std::size_t input_bytes, const std::vector<std::function<void()>>& readers,
              std::size_t allowance) {
  call(input_bytes, readers[input_bytes % readers.size()], allowance);
}

}  // namespace fuzz
