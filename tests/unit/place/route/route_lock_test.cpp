#include "support/temporary_folder.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <place/route/route_database.hpp>
#include <place/route/route_lock.hpp>
#include <vo/base/error.hpp>

namespace {

using test_support::TemporaryFolder;

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

TEST(RouteLock, IsForOneAtATime) {
  const TemporaryFolder folder;
  const auto route = folder / "route.db";
  {
    const place::RouteLock lock(route);
    bool waited = false;
    EXPECT_THROW_WITH(place::RouteLock(route, {.wait_s = 0.1, .waiting = [&] { waited = true; }}), vo::Error,
                      "route.db: is being written by another program (process " + std::to_string(::getpid()));
    EXPECT_TRUE(waited);
    const place::RouteLock other(folder / "other.db");  // another route's is free
  }
  EXPECT_EQ(files_in(folder.path()), 0);
  const place::RouteLock again(route, {.wait_s = 0});
}

TEST(RouteLock, WaitsForAnotherProcess) {
  const TemporaryFolder folder;
  const auto route = folder / "route.db";
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    {
      const place::RouteLock lock(route);
      if (::write(ready[1], "x", 1) != 1) ::_exit(1);
      ::usleep(200'000);
      folder.write("order", "child");
    }
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  {
    const place::RouteLock lock(route);  // when the child is done
    EXPECT_EQ(test_support::read_file(folder / "order"), "child");
  }
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(RouteLock, OneOfADeadProcessStopsNobody) {
  const TemporaryFolder folder;
  const auto route = folder / "route.db";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const place::RouteLock lock(route);
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(files_in(folder.path()), 1);  // its file is left behind
  EXPECT_NO_THROW(place::RouteLock(route, {.wait_s = 0}));
  EXPECT_EQ(files_in(folder.path()), 0);
}

TEST(RouteLock, ALinkAndItsFileHaveOneLock) {
  const TemporaryFolder folder;
  const auto route = folder.write("route.db", "x");
  std::filesystem::create_symlink(route, folder / "link.db");
  const place::RouteLock lock(folder / "link.db");
  EXPECT_THROW(place::RouteLock(route, {.wait_s = 0}), vo::Error);
}

TEST(RouteLock, SeesThatTheRouteWasReplaced) {
  const TemporaryFolder folder;
  const auto route = folder.write("route.db", "one");
  const place::RouteLock lock(route);
  folder.write("new", "two");
  std::filesystem::rename(folder / "new", route);  // by a program that knows nothing of the lock
  EXPECT_THROW_WITH(lock.write({}), vo::Error, "route.db: was changed by another program meanwhile");
  EXPECT_EQ(test_support::read_file(route), "two");
  const place::RouteLock first(folder / "first.db");  // a route that is not there yet
  folder.write("first.db", "x");
  EXPECT_THROW(first.write({}), vo::Error);
}

TEST(RouteLock, WritesARouteThatNobodyElseChanged) {
  const TemporaryFolder folder;
  const auto file = folder / "route.db";
  place::Route route;
  route.unit = 0.5;
  place::RouteLock(file).write(route);
  EXPECT_EQ(place::read_route(file).unit, 0.5);
  route.unit = 2;
  place::RouteLock(file).write(route);
  EXPECT_EQ(place::read_route(file).unit, 2);
}

TEST(RouteLock, SaysWhyItCannotBeTaken) {
  const TemporaryFolder folder;
  EXPECT_THROW_WITH(place::RouteLock(folder / "none" / "route.db"), vo::Error,
                    "route.db: cannot be written: ");
  EXPECT_THROW(place::RouteLock(folder / "route.db", {.wait_s = -1}), std::invalid_argument);
}

}  // namespace
