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
/// nested call is shared with the threads that have nothing else to do. If calls throw, the exception of the
/// smallest throwing index that was run is rethrown after all threads have stopped. This is the only place of
/// the project that starts threads. They come from oneTBB, whose idle threads sleep: those of OpenMP
/// (libgomp) spin, and so took a third of the processor time of `retrace build` from the video decoder's own
/// threads.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls `first()` and `second()`, at the same time where there are threads for it, and returns after both:
/// the next frames are decoded while the last are worked on. `parallel_for` within either uses the threads
/// that are free. If one throws, the other may not be started; if both do, the exception of `first` is
/// rethrown.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace vo
