#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/base/stopping.hpp>

namespace {

using namespace std::chrono_literals;

class StoppingWork : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { vo::set_thread_count(GetParam()); }
  void TearDown() override { vo::set_thread_count(0); }
};
INSTANTIATE_TEST_SUITE_P(Threads, StoppingWork, testing::Values(1, 2, 5));

/// Far more indices than can be worked on; the loop ends only by being stopped.
constexpr std::size_t kEndless = 1'000'000;

TEST_P(StoppingWork, EndsALoopOfAnyNumberOfThreads) {
  std::atomic<int> asked = 0;
  const auto caller = std::this_thread::get_id();
  const vo::Stopping stopping([&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return ++asked == 3;
  });
  EXPECT_THROW(vo::parallel_for(kEndless, [](std::size_t) { std::this_thread::sleep_for(1ms); }),
               vo::Stopped);
  EXPECT_EQ(asked, 3);
  // It stays so: what would be done next is not begun.
  EXPECT_THROW(vo::parallel_for(1, [](std::size_t) { FAIL(); }), vo::Stopped);
  EXPECT_EQ(asked, 3);
}

TEST_P(StoppingWork, EndsLoopsWithinLoops) {
  const vo::Stopping stopping([] { return true; });
  const auto inner = [](std::size_t) {
    vo::parallel_for(kEndless, [](std::size_t) { std::this_thread::sleep_for(1ms); });
  };
  EXPECT_THROW(vo::keep_threads([&] { vo::parallel_for(3, inner); }), vo::Stopped);
}

/// The calling thread has nothing left to do and waits; it still asks, and the others end.
TEST_P(StoppingWork, AsksWhileTheCallerWaits) {
  const vo::Stopping stopping([] { return true; });
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> helped = false;
  const auto body = [&](std::size_t) {
    if (GetParam() > 1 && std::this_thread::get_id() == caller) {
      while (!helped) std::this_thread::sleep_for(1ms);  // it would else take the other index too
      return;
    }
    helped = true;
    for (;;) {
      vo::stop_if_asked();
      std::this_thread::sleep_for(1ms);
    }
  };
  EXPECT_THROW(vo::parallel_for(2, body), vo::Stopped);
}

TEST_P(StoppingWork, LeavesOtherWorkAlone) {
  {
    const vo::Stopping stopping([] { return true; });
    EXPECT_THROW(
        {
          for (;;) vo::stop_if_asked();
        },
        vo::Stopped);
    const vo::Stopping inner([] { return false; });
    vo::stop_if_asked();
    std::thread([] { vo::stop_if_asked(); }).join();
  }
  std::atomic<int> calls = 0;
  vo::parallel_for(1000, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 1000);
  const vo::Stopping never([] { return false; });
  EXPECT_THROW(vo::parallel_for(10, [](std::size_t) { throw std::runtime_error("mine"); }),
               std::runtime_error);
}

}  // namespace
