#include "vo/base/parallel.hpp"

#include "vo/base/stopping.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include <omp.h>

namespace vo {
namespace {

/// Keeps the exception of the smallest index that threw; after the first, nothing more is started.
class FirstFailure {
 public:
  template <typename Body>
  void guard(std::size_t index, const Body& body) {
    if (stop_.load(std::memory_order_relaxed)) return;
    try {
      body();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!exception_ || index < index_) {
        index_ = index;
        exception_ = std::current_exception();
      }
      stop_ = true;
    }
  }

  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr exception_;
  std::size_t index_ = 0;
  std::atomic<bool> stop_{false};
};

/// Guards what teams and loops know of their threads. A single one, which lives as long as the program, as
/// that alone orders for ThreadSanitizer what a thread sees of a team when it enters a region.
std::mutex bookkeeping;

/// A call of `parallel_for` that is under way.
struct Loop {
  std::size_t count;
  std::size_t chunk;  ///< indices that a thread takes at a time
  const std::function<void(std::size_t)>& body;
  Loop* outer;                               ///< within whose body it was called; null for the outermost
  Stopping* stopping = Stopping::current();  ///< of the thread that called, and so of all that help it

  std::atomic<std::size_t> next{0};  ///< the first index that nobody has taken
  FirstFailure failure{};

  // Guarded by `bookkeeping`.
  std::size_t helpers = 0;            ///< threads that work on it beside the one that called
  bool caller_sleeps = false;         ///< until no helper is left, or there is something to help with
  std::condition_variable changed{};  ///< wakes the caller

  [[nodiscard]] bool all_taken() const { return next.load(std::memory_order_relaxed) >= count; }
  [[nodiscard]] bool is_within(const Loop* other) const {
    const Loop* loop = this;
    while (loop != nullptr && loop != other) loop = loop->outer;
    return loop != nullptr;
  }
};

class Team;
thread_local Team* the_team = nullptr;  ///< that this thread is a member of
thread_local Loop* the_loop = nullptr;  ///< whose body this thread is in

/// Calls the body for indices that nobody has taken until there are none.
void work_on(Loop& loop) {
  Loop* const outer = std::exchange(the_loop, &loop);
  Stopping* const before = Stopping::exchange_current(loop.stopping);
  for (;;) {
    const std::size_t begin = loop.next.fetch_add(loop.chunk, std::memory_order_relaxed);
    if (begin >= loop.count) break;
    for (std::size_t i = begin; i < std::min(loop.count, begin + loop.chunk); ++i)
      loop.failure.guard(i, [&] {
        stop_if_asked();
        loop.body(i);
      });
  }
  Stopping::exchange_current(before);
  the_loop = outer;
}

/// The threads of a parallel region. One of them runs the outermost loop, the others serve; every loop that
/// any of them comes upon is listed here for those that have nothing to do.
class Team {
 public:
  // The mutex is taken at both ends of life, which orders what comes before and after.
  Team() { const std::scoped_lock lock(bookkeeping); }
  ~Team() { const std::scoped_lock lock(bookkeeping); }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Called by a member: runs a loop with the help of the others.
  void run(Loop& loop) {
    std::unique_lock lock(bookkeeping);
    open_.push_back(&loop);
    wake_for(loop);
    lock.unlock();
    work_on(loop);
    lock.lock();
    // Its last indices may be long and have loops of their own, which are helped with meanwhile.
    while (loop.helpers > 0) {
      if (Loop* const inner = find_open(&loop)) {
        help(*inner, lock);
      } else {
        loop.caller_sleeps = true;
        sleep_until_woken(loop, lock);
      }
    }
    std::erase(open_, &loop);
  }

  /// Helps with whatever is listed until the team is closed.
  void serve() {
    std::unique_lock lock(bookkeeping);
    while (!closed_) {
      if (Loop* const loop = find_open(nullptr)) {
        help(*loop, lock);
      } else {
        ++sleeping_;
        listed_.wait(lock, [&] { return woken_ > 0 || closed_; });
        if (!closed_) --woken_;
      }
    }
  }

  void close() {
    const std::scoped_lock lock(bookkeeping);
    closed_ = true;
    listed_.notify_all();
  }

 private:  // all of it under `bookkeeping`
  /// The loop that was listed first, as an index of an outer loop is more work, and lies within another (null
  /// means any).
  [[nodiscard]] Loop* find_open(const Loop* within) const {
    const auto found = std::ranges::find_if(open_, [&](const Loop* loop) {
      return !loop->all_taken() && (within == nullptr || loop->is_within(within));
    });
    return found == open_.end() ? nullptr : *found;
  }

  void help(Loop& loop, std::unique_lock<std::mutex>& lock) {
    ++loop.helpers;
    lock.unlock();
    work_on(loop);
    lock.lock();
    if (--loop.helpers == 0) wake_caller(loop);
  }

  /// Where the caller is the one that is asked whether to stop, it goes on asking; those it waits for stop.
  static void sleep_until_woken(Loop& loop, std::unique_lock<std::mutex>& lock) {
    const auto woken = [&] { return !loop.caller_sleeps; };
    if (loop.stopping == nullptr || !loop.stopping->is_of_this_thread())
      return loop.changed.wait(lock, woken);
    while (!loop.changed.wait_until(lock, std::chrono::system_clock::now() + Stopping::kInterval, woken)) {
      lock.unlock();
      loop.stopping->poll();
      lock.lock();
    }
  }

  static void wake_caller(Loop& loop) {
    if (std::exchange(loop.caller_sleeps, false)) loop.changed.notify_one();
  }

  /// Wakes as many as there is something to do for: those that serve, then those that wait for an outer loop.
  void wake_for(const Loop& loop) {
    std::size_t wanted = (loop.count - 1) / loop.chunk;
    for (; wanted > 0 && sleeping_ > 0; --wanted, --sleeping_, ++woken_) listed_.notify_one();
    for (Loop* outer = loop.outer; outer != nullptr && wanted > 0; outer = outer->outer) {
      if (!outer->caller_sleeps) continue;
      wake_caller(*outer);
      --wanted;
    }
  }

  std::vector<Loop*> open_;   ///< in the order in which they were listed
  std::size_t sleeping_ = 0;  ///< of those that serve, and are not woken yet
  std::size_t woken_ = 0;     ///< and are yet to notice
  bool closed_ = false;
  std::condition_variable listed_;
};

std::atomic<int> wanted_threads{0};  // 0: as many as OpenMP gives

/// Opens a region of several threads for an outermost loop. Left out of ThreadSanitizer's view: how the
/// address of the team comes to the other threads is the runtime's affair.
__attribute__((noinline, no_sanitize("thread"))) void run_in_region(Loop& loop, int threads) {
  Team team;
#pragma omp parallel num_threads(threads) default(none) shared(team, loop)
  {
    the_team = &team;
    if (omp_get_thread_num() == 0) {
      team.run(loop);
      team.close();
    } else {
      team.serve();
    }
    the_team = nullptr;
  }
}

}  // namespace

void set_thread_count(int threads) {
  if (threads < 0) throw std::invalid_argument("set_thread_count: threads must be >= 0");
  wanted_threads = threads;
}

int thread_count() {
  const int wanted = wanted_threads;
  return wanted > 0 ? wanted : std::max(1, omp_get_max_threads());
}

void keep_threads(const std::function<void()>& body) {
  const int threads = thread_count();
  if (threads == 1 || the_team != nullptr) return body();
  const std::function<void(std::size_t)> once = [&](std::size_t) { body(); };
  Loop loop{.count = 1, .chunk = 1, .body = once, .outer = the_loop};
  run_in_region(loop, threads);
  loop.failure.rethrow();
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const int threads = thread_count();
  // Enough parts for each thread that none waits long for the last, where there are many indices.
  constexpr std::size_t kParts = 32;
  Loop loop{.count = count,
            .chunk = std::max<std::size_t>(1, count / (kParts * static_cast<std::size_t>(threads))),
            .body = body,
            .outer = the_loop};
  if (threads == 1 || count <= 1) {
    work_on(loop);
  } else if (the_team != nullptr) {
    the_team->run(loop);
  } else {
    run_in_region(loop, threads);
  }
  loop.failure.rethrow();
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
  parallel_for(2, [&](std::size_t i) { i == 0 ? first() : second(); });
}

}  // namespace vo
