#include "launched_team.hpp"

#include "mpi_calls.hpp"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <new>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace retrace {
namespace {

constexpr std::int64_t kFailedMember = -1;

/// A number from the environment, as mpirun sets it; 0 without.
int number_of(const char* name) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : 0;
}

}  // namespace

LaunchedTeam::LaunchedTeam(const MpiCalls& calls) : calls_(calls) {}
LaunchedTeam::~LaunchedTeam() {
  calls_.end();
}

std::size_t LaunchedTeam::size() const {
  return static_cast<std::size_t>(calls_.size);
}

std::size_t LaunchedTeam::rank() const {
  return static_cast<std::size_t>(calls_.rank);
}

std::vector<place::Team::Message> LaunchedTeam::exchange(std::span<const std::uint8_t> message) {
  return gather(message, true);
}

std::vector<place::Team::Message> LaunchedTeam::collect(std::span<const std::uint8_t> message) {
  return gather(message, false);
}

void LaunchedTeam::fail(const std::string& what) {
  if (std::exchange(failed_, true)) return;
  std::vector<std::int64_t> sizes(size());
  calls_.gather_numbers(kFailedMember - static_cast<std::int64_t>(what.size()), sizes.data());
  // Whoever is the first to fail says why; the others receive it.
  const auto first = std::ranges::find_if(sizes, [](std::int64_t bytes) { return bytes < 0; });
  std::vector<int> counts(size(), 0), starts(size(), 0);
  const auto speaker = static_cast<std::size_t>(first - sizes.begin());
  counts[speaker] = static_cast<int>(kFailedMember - *first);
  std::string text(static_cast<std::size_t>(counts[speaker]), ' ');
  calls_.gather_bytes(what.data(), speaker == rank() ? counts[speaker] : 0, text.data(), counts.data(),
                      starts.data(), true);
}

std::vector<place::Team::Message> LaunchedTeam::gather(std::span<const std::uint8_t> message,
                                                       bool to_everyone) {
  std::vector<std::int64_t> sizes(size());
  calls_.gather_numbers(static_cast<std::int64_t>(message.size()), sizes.data());
  const auto failed = std::ranges::find_if(sizes, [](std::int64_t bytes) { return bytes < 0; });
  std::vector<int> counts(size(), 0), starts(size(), 0);
  if (failed != sizes.end()) {
    failed_ = true;
    const auto speaker = static_cast<std::size_t>(failed - sizes.begin());
    counts[speaker] = static_cast<int>(kFailedMember - *failed);
    std::string text(static_cast<std::size_t>(counts[speaker]), ' ');
    calls_.gather_bytes(nullptr, 0, text.data(), counts.data(), starts.data(), true);
    throw vo::Error(fmt::format("process {}", speaker), text);
  }
  // MPI counts in int, so a large message goes in rounds.
  constexpr std::int64_t kRound = std::int64_t{1} << 30;
  const std::int64_t each = kRound / static_cast<std::int64_t>(size());
  std::vector<Message> all(size());
  const bool mine = to_everyone || rank() == 0;
  const std::int64_t longest = *std::ranges::max_element(sizes);
  std::vector<std::uint8_t> together;
  for (std::int64_t done = 0; done < longest; done += each) {
    int total = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      counts[i] = static_cast<int>(std::clamp<std::int64_t>(sizes[i] - done, 0, each));
      starts[i] = total;
      total += counts[i];
    }
    try {
      together.resize(mine ? static_cast<std::size_t>(total) : 0);
      const auto from = std::min(message.size(), static_cast<std::size_t>(done));
      calls_.gather_bytes(message.data() + from, counts[rank()], together.data(), counts.data(),
                          starts.data(), to_everyone);
      for (std::size_t i = 0; i < size() && mine; ++i)
        all[i].insert(all[i].end(), together.begin() + starts[i], together.begin() + starts[i] + counts[i]);
    } catch (const std::bad_alloc&) {  // the others are in the midst of an exchange, and cannot be told
      fmt::print(stderr, "retrace: process {}: out of memory\n", rank());
      calls_.abort();
      throw;
    }
  }
  bytes_sent_ += message.size() * (to_everyone ? size() - 1 : (rank() == 0 ? 0 : 1));
  if (!mine) all.clear();
  return all;
}

bool is_launched() {
  return number_of("OMPI_COMM_WORLD_SIZE") > 1;
}

std::unique_ptr<LaunchedTeam> launched_team() {
  if (!is_launched()) return nullptr;
#ifdef RETRACE_MPI_MODULE
  // It is beside the module that this is in. Open MPI's plugins expect its symbols to be global.
  Dl_info self{};
  ::dladdr(reinterpret_cast<void*>(&launched_team), &self);
  const std::filesystem::path beside(self.dli_fname != nullptr ? self.dli_fname : "");
  void* const module = ::dlopen((beside.parent_path() / RETRACE_MPI_MODULE).c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const begin = module != nullptr ? ::dlsym(module, "retrace_mpi_begin") : nullptr;
  if (begin == nullptr) throw vo::Error("mpirun", ::dlerror(), "the module of this build beside the program");
  return std::make_unique<LaunchedTeam>(*reinterpret_cast<BeginMpi*>(begin)());
#else
  throw vo::Error("mpirun", "started several processes, and this build has no MPI",
                  "one process, or a build where CMake finds libopenmpi-dev");
#endif
}

int threads_of_each() {
  const int processes = number_of("OMPI_COMM_WORLD_LOCAL_SIZE");
  if (processes < 2) return 0;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / processes);
}

}  // namespace retrace
