#include "stored_run.hpp"

#include "mpi_calls.hpp"
#include "support/temporary_folder.hpp"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/error.hpp>

namespace {

using retrace::LaunchedTeam;
using retrace::run_as_team;
using retrace::stored_run;

std::int64_t last_said = 0;  // a number of bytes, or below 0 for a failure

/// One of two processes, of which the other says the same.
MpiCalls one_of_two(int rank) {
  return {.size = 2,
          .rank = rank,
          .gather_numbers =
              [](std::int64_t mine, std::int64_t* all) {
                last_said = mine;
                all[0] = all[1] = mine;
              },
          .gather_bytes = [](const void*, int, void*, const int*, const int*, bool) {},
          .end = [] {},
          .abort = [] {}};
}

TEST(StoredRun, IsOfATeamOrWithinMemory) {
  EXPECT_FALSE(stored_run(nullptr, ""));
  EXPECT_THROW_WITH(stored_run(nullptr, "2"), vo::Error, "--memory 2: is no amount of memory");
  const MpiCalls calls = one_of_two(0);
  LaunchedTeam team(calls);
  const auto stored = stored_run(&team, "");
  ASSERT_TRUE(stored);
  EXPECT_EQ(stored->team, &team);
  EXPECT_FALSE(stored->memory_bytes);
  EXPECT_THROW_WITH(stored_run(&team, "2G"), vo::Error, "--memory: has no effect on several processes");
}

TEST(StoredRun, TheFirstOfATeamRunsAndTheOthersServe) {
  for (const int rank : {0, 1}) {
    const MpiCalls calls = one_of_two(rank);
    LaunchedTeam team(calls);
    std::string did;
    run_as_team(
        team, [&] { did += "ran"; }, [&] { did += "served"; });
    EXPECT_EQ(did, rank == 0 ? "ran" : "served");
  }
}

TEST(StoredRun, AnErrorOfOneEndsAllAndTheFirstThrowsIt) {
  const auto fails = [] { throw std::runtime_error("broke"); };
  const MpiCalls first_calls = one_of_two(0), second_calls = one_of_two(1);
  LaunchedTeam first(first_calls), second(second_calls);
  last_said = 0;
  EXPECT_THROW_WITH(run_as_team(first, fails, [] {}), std::runtime_error, "broke");
  EXPECT_LT(last_said, 0);
  last_said = 0;
  EXPECT_NO_THROW(run_as_team(
      second, [] {}, fails));
  EXPECT_LT(last_said, 0);
}

}  // namespace
