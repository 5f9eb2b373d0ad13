#include "vo/base/parallel.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>

#include <omp.h>

namespace vo {
namespace {

std::atomic<int> requested_threads{0};

}  // namespace

void set_thread_count(int threads) {
  if (threads < 0) throw std::invalid_argument("set_thread_count: threads must be >= 0");
  requested_threads = threads;
}

int thread_count() {
  const int requested = requested_threads;
  return requested > 0 ? requested : omp_get_num_procs();
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::mutex mutex;
  std::exception_ptr failure;
  std::size_t failed_index = count;
  std::atomic<bool> stop{false};
  const auto n = static_cast<std::ptrdiff_t>(count);

#pragma omp parallel for schedule(dynamic) num_threads(thread_count()) if (n > 1 && !omp_in_parallel())
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    if (stop.load(std::memory_order_relaxed)) continue;
    try {
      body(static_cast<std::size_t>(i));
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (static_cast<std::size_t>(i) < failed_index) {
        failed_index = static_cast<std::size_t>(i);
        failure = std::current_exception();
      }
      stop = true;
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace vo
