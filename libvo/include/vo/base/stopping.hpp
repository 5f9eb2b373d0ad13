#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

namespace vo {

/// Thrown out of long work that was asked to stop. Whoever asked for it catches it; nothing that the work
/// would have returned or written is there then.
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "stopped"; }
};

/// While an object of this class lives, long work that its thread calls for can be stopped: `asked` is called
/// on that thread ten times a second, and once it returns true the work ends with `Stopped`, on all threads
/// of `parallel_for`. For a user's interface whose Ctrl-C must not end the process, such as Python's.
///
/// Every index of `parallel_for` is a place where work may stop; long work of one thread calls
/// `stop_if_asked`. An `asked` that throws is a programming error. Objects may be nested; the innermost
/// counts.
class Stopping {
 public:
  explicit Stopping(std::function<bool()> asked);
  ~Stopping();
  Stopping(const Stopping&) = delete;
  Stopping& operator=(const Stopping&) = delete;

  /// That of the calling thread; null for none.
  static Stopping* current();
  /// Makes the calling thread, which helps the one that `stopping` belongs to, stop with it. Returns what it
  /// had before.
  static Stopping* exchange_current(Stopping* stopping);

  /// Asks, on the thread it belongs to and where that is due. True once the work must stop.
  bool poll();
  [[nodiscard]] bool is_of_this_thread() const { return std::this_thread::get_id() == owner_; }

  /// Between two times of asking.
  static constexpr std::chrono::milliseconds kInterval{100};

 private:
  std::function<bool()> asked_;
  std::thread::id owner_ = std::this_thread::get_id();
  std::chrono::steady_clock::time_point due_ = std::chrono::steady_clock::now() + kInterval;
  std::atomic<bool> stopped_ = false;
  Stopping* outer_;
};

/// Throws `Stopped` if the work that the calling thread is at was asked to stop. Cost: some 30 ns, nothing
/// where no `Stopping` lives.
inline void stop_if_asked() {
  if (Stopping* const stopping = Stopping::current(); stopping != nullptr && stopping->poll())
    throw Stopped();
}

}  // namespace vo
