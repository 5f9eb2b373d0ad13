#include <atomic>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>

namespace {

using testing::Each;
using testing::StrEq;

/// Each with another number of threads than this machine need have, and the usual number again at the end.
class Parallel : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { vo::set_thread_count(GetParam()); }
  void TearDown() override { vo::set_thread_count(0); }
};
INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(1, 2, 5));

TEST_P(Parallel, RunsEveryIndexOnce) {
  for (const std::size_t count : {0, 1, 2, 1000, 100'003}) {
    std::vector<int> calls(count, 0);
    vo::parallel_for(count, [&](std::size_t i) { ++calls[i]; });
    EXPECT_THAT(calls, Each(1));
  }
}

TEST_P(Parallel, RunsNestedCalls) {
  std::vector<std::vector<int>> grid(9, std::vector<int>(300, 0));
  vo::parallel_for(grid.size(), [&](std::size_t i) {
    vo::parallel_for(grid[i].size() / 3, [&](std::size_t j) {
      vo::parallel_for(3, [&](std::size_t k) { ++grid[i][3 * j + k]; });
    });
  });
  for (const std::vector<int>& row : grid) EXPECT_THAT(row, Each(1));
}

/// A thread that waits for the last calls of its loop takes part in theirs, as deep as they are.
TEST_P(Parallel, InvokesBothHoweverDeep) {
  const auto fibonacci = [](const auto& self, int n) -> long {
    if (n < 2) return n;
    long before = 0, last = 0;
    vo::parallel_invoke([&] { before = self(self, n - 2); }, [&] { last = self(self, n - 1); });
    return before + last;
  };
  EXPECT_EQ(fibonacci(fibonacci, 12), 144);
}

TEST_P(Parallel, KeepsThreadsForTheCallsWithin) {
  std::vector<int> calls(100, 0);
  const auto once = [&](std::size_t i) { ++calls[i]; };
  vo::keep_threads([&] {
    vo::parallel_for(calls.size(), once);
    vo::keep_threads([&] { vo::parallel_for(calls.size(), once); });
    vo::parallel_invoke([&] { vo::parallel_for(calls.size(), once); }, [] {});
  });
  EXPECT_THAT(calls, Each(3));
  EXPECT_THROW(vo::keep_threads([] { throw std::runtime_error("body"); }), std::runtime_error);
  vo::parallel_for(calls.size(), once);
  EXPECT_THAT(calls, Each(4));
}

TEST_P(Parallel, WorksFromSeveralThreadsOfTheCallersOwn) {
  std::vector<std::size_t> sums(3, 0);
  std::vector<std::thread> callers;
  for (std::size_t& sum : sums) {
    callers.emplace_back([&sum] {
      std::vector<std::size_t> values(1000);
      for (int repeat = 0; repeat < 20; ++repeat) {
        vo::parallel_for(values.size(), [&](std::size_t i) { values[i] += i; });
      }
      sum = std::accumulate(values.begin(), values.end(), std::size_t{0});
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_THAT(sums, Each(std::size_t{20} * 999 * 1000 / 2));
}

std::string thrown_by(const auto& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST_P(Parallel, RethrowsAndGoesOnWorking) {
  const auto four = [](std::size_t i) {
    if (i == 4) throw std::runtime_error("four");
  };
  EXPECT_THAT(thrown_by([&] { vo::parallel_for(10, four); }), StrEq("four"));
  EXPECT_THAT(thrown_by([&] { vo::parallel_for(3, [&](std::size_t) { vo::parallel_for(10, four); }); }),
              StrEq("four"));
  const auto nothing = [] {};
  EXPECT_THAT(thrown_by([&] { vo::parallel_invoke([] { throw std::runtime_error("first"); }, nothing); }),
              StrEq("first"));
  EXPECT_THAT(thrown_by([&] { vo::parallel_invoke(nothing, [] { throw std::runtime_error("second"); }); }),
              StrEq("second"));
  std::atomic<int> calls = 0;
  vo::parallel_for(100, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 100);
}

/// Of calls that all run, the smallest index counts. Both wait for the other to have begun, so that neither
/// keeps the other from running.
TEST(ParallelFor, RethrowsTheSmallestIndexThatThrew) {
  vo::set_thread_count(2);
  std::atomic<int> begun = 0;
  const auto both = [&](std::size_t i) {
    for (++begun; begun < 2;) std::this_thread::yield();
    throw std::runtime_error(std::to_string(i));
  };
  EXPECT_THAT(thrown_by([&] { vo::parallel_for(2, both); }), StrEq("0"));
  vo::set_thread_count(0);
}

TEST(SetThreadCount, ChecksItsArgument) {
  EXPECT_THROW(vo::set_thread_count(-1), std::invalid_argument);
  vo::set_thread_count(7);
  EXPECT_EQ(vo::thread_count(), 7);
  vo::set_thread_count(0);
  EXPECT_GE(vo::thread_count(), 1);
}

}  // namespace
