#include "vo/base/parallel.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>
#include <stdexcept>

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

std::mutex arena_mutex;
std::shared_ptr<tbb::task_arena> the_arena;

/// Where all work is done; a nested call finds itself inside and shares its threads.
std::shared_ptr<tbb::task_arena> arena() {
  const std::scoped_lock lock(arena_mutex);
  if (!the_arena) the_arena = std::make_shared<tbb::task_arena>();
  return the_arena;
}

}  // namespace

void set_thread_count(int threads) {
  if (threads < 0) throw std::invalid_argument("set_thread_count: threads must be >= 0");
  const std::scoped_lock lock(arena_mutex);
  the_arena = threads == 0 ? std::make_shared<tbb::task_arena>() : std::make_shared<tbb::task_arena>(threads);
}

int thread_count() {
  return arena()->max_concurrency();
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  FirstFailure failure;
  arena()->execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { failure.guard(i, [&] { body(i); }); });
  });
  failure.rethrow();
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
  FirstFailure failure;
  arena()->execute(
      [&] { tbb::parallel_invoke([&] { failure.guard(0, first); }, [&] { failure.guard(1, second); }); });
  failure.rethrow();
}

}  // namespace vo
