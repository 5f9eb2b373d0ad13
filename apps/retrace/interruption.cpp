#include "interruption.hpp"

#include "launched_team.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <fcntl.h>
#include <string_view>
#include <system_error>
#include <thread>
#include <unistd.h>

#include <vo/io/partial_path.hpp>

namespace retrace {
namespace {

std::array<int, 2> pipe_ends{-1, -1};
std::atomic<int> recordings = 0;
std::atomic<bool> recording_ended = false;
bool one_of_many = false;  ///< started by mpirun, which ends the others when one ends, and says so

static_assert(std::atomic<int>::is_always_lock_free, "atomics in a signal handler");

/// A handler may do next to nothing: it passes the signal on to a thread that may.
extern "C" void pass_on_signal(int signal) {
  if (recordings > 0 && !recording_ended.exchange(true)) return;
  const auto number = static_cast<unsigned char>(signal);
  [[maybe_unused]] const ssize_t written = ::write(pipe_ends[1], &number, 1);
}

[[noreturn]] void end_program() {
  unsigned char signal = 0;
  while (::read(pipe_ends[0], &signal, 1) != 1) {
  }
  vo::discard_partial_paths();
  if (!one_of_many) {
    constexpr std::string_view kSaid = "retrace: interrupted; what was not finished is not kept\n";
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kSaid.data(), kSaid.size());
  }
  constexpr int kOfSignals = 128;  // as shells count
  ::_exit(kOfSignals + signal);
}

}  // namespace

void end_on_signals() {
  one_of_many = is_launched();
  if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return;  // then they end the program at once
  try {
    std::thread(end_program).detach();
  } catch (const std::system_error&) {
    return;  // no thread to be had: signals end the program at once
  }
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) std::signal(signal, pass_on_signal);  // nohup, background jobs
  }
}

EndableReading::EndableReading() {
  recording_ended = false;
  ++recordings;
}

EndableReading::~EndableReading() {
  --recordings;
}

bool EndableReading::ended() {
  return recording_ended;
}

}  // namespace retrace
