#pragma once

#include <cstddef>
#include <functional>

namespace vo {

/// Sets how many threads `parallel_for` uses; 0 means as many as OpenMP gives: one per core, or what
/// OMP_NUM_THREADS says. Throws `std::invalid_argument` below 0.
void set_thread_count(int threads);

/// The number of threads `parallel_for` uses, at least 1.
int thread_count();

/// Calls `body(i)` for every i in [0, count), spread over `thread_count()` threads in no particular order.
///
/// Each index must write only to places of its own; the outcome is then the same for any number of threads. A
/// nested call is shared with the threads that have nothing else to do. If calls throw, the exception of the
/// smallest throwing index that was run is rethrown after all threads have stopped. This is the only place of
/// the project that starts threads.
///
/// The threads are OpenMP's. An outermost call opens a parallel region, and a call within it opens none: it
/// lists its indices for the threads of the region, which sleep while nothing is listed. So an idle thread
/// takes no processor time from a video decoder's own threads. Where a region begins and ends the runtime
/// decides how its threads wait for each other: libgomp's spin for about 3 ms and then sleep, which is costly
/// on a busy processor. The program `retrace` makes them sleep at once by setting OMP_WAIT_POLICY=passive
/// before libgomp is loaded; other programs get the same by setting that variable in the environment in which
/// they are started. Make calls that follow each other closely within one `keep_threads`.
///
/// ThreadSanitizer sees how the work of threads is ordered, because a mutex of this project does it. It does
/// not see how a region is entered, which happens inside the runtime, so that one function is excluded from
/// it. GCC's ThreadSanitizer then needs no suppressions; Clang's asks for
/// TSAN_OPTIONS=ignore_noninstrumented_modules=1.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls `body()` with the threads at hand until it returns: calls of `parallel_for` and `parallel_invoke`
/// within it share one region. What `body` throws is thrown on.
void keep_threads(const std::function<void()>& body);

/// Calls `first()` and `second()`, at the same time where there are threads for it, and returns after both:
/// the next frames are decoded while the last are worked on. `parallel_for` within either uses the threads
/// that are free, the caller's own too once its part is done. If one throws, the other may not be started; if
/// both do, the exception of `first` is rethrown.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace vo
