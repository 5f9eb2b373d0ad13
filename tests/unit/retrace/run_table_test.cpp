#include "run_table.hpp"

#include <string>

#include <gtest/gtest.h>

namespace {

TEST(RunTable, CountsMatches) {
  vo::Walk walk;
  walk.source = "night.mp4";
  walk.time_s = {0, 0.5, 1, 1.5, 2};
  place::Route route;
  route.traverses.emplace_back().name = "day";
  route.traverses[0].keyframes.resize(12);
  place::Run run;
  run.matches.resize(4);  // three matched, one of them on part of a line, two accepted
  for (const std::size_t i : {0U, 1U, 2U}) run.matches[i].place.emplace();
  run.matches[0].partial = true;
  run.matches[1].accepted = run.matches[2].accepted = true;
  run.settings.accept_probability = 0.5;
  EXPECT_EQ(retrace::run_table(walk, route, "route.db", run),
            "night.mp4 on route.db\n"
            "  query keyframes           4   of 5 frames\n"
            "  matched                   3   1 on part of a line\n"
            "  accepted                  2   probability 0.5 or more\n"
            "  route keyframes          12   day\n");
  run.settings.accept_score = 0.25;
  EXPECT_NE(retrace::run_table(walk, route, "route.db", run).find("score 0.25 or more"), std::string::npos);
}

}  // namespace
