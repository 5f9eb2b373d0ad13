#pragma once

#include <cstddef>
#include <functional>

namespace vo {

/// Sets how many threads `parallel_for` uses; 0 means one per core. Throws `std::invalid_argument` below 0.
void set_thread_count(int threads);

/// The number of threads `parallel_for` uses, at least 1.
int thread_count();

/// Calls `body(i)` for every i in [0, count), spread over `thread_count()` threads in no particular order.
///
/// Each index must write only to places of its own; the outcome is then the same for any number of threads. A
/// nested call runs on the calling thread. If calls throw, the exception of the smallest throwing index that
/// was run is rethrown after all threads have stopped. This is the only place of the project that starts
/// OpenMP threads.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace vo
