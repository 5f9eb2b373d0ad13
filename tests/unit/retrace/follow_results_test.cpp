#include "follow_results.hpp"

#include "support/temporary_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using retrace::FollowResults;
using test_support::read_file;
using test_support::TemporaryFolder;
using testing::HasSubstr;

place::Route one_keyframe() {
  place::Route route;
  place::Traverse& traverse = route.traverses.emplace_back();
  traverse.name = "day";
  traverse.keyframes.push_back({.frame = 0, .time_s = 0, .distance_m = 0.0});
  return route;
}

/// A frame every half second, which was found at the route's start or not.
place::Position at_start(std::int64_t frame, bool found) {
  place::Position position;
  position.frame = frame;
  position.time_s = static_cast<double>(frame) / 2;
  position.described = true;
  if (!found) return position;
  position.state = place::FollowState::kOnRoute;
  position.place.emplace();
  position.place->traverse = "day";
  position.place->probability = 0.75;
  return position;
}

vo::Frame black() {
  return {.index = 0, .time_s = 0, .image = cv::Mat::zeros(4, 4, CV_8UC1), .colour = {}};
}

TEST(FollowResults, AreLinesAtOnce) {
  const place::Route route = one_keyframe();
  place::FollowEvent found;
  found.frame = 1;
  testing::internal::CaptureStdout();
  FollowResults results(route, {});
  results.push(at_start(0, false), black(), {});
  results.push(at_start(1, true), black(), {found});
  const std::string lines = testing::internal::GetCapturedStdout();
  EXPECT_EQ(std::ranges::count(lines, '\n'), 3);
  EXPECT_LT(lines.find("searching"), lines.find("on_route"));
  EXPECT_LT(lines.find("on_route"), lines.find(R"("event":"found")"));
  EXPECT_THAT(lines, HasSubstr(R"("event":"found")"));
}

TEST(FollowResults, AreFilesWhenAllIsThere) {
  const TemporaryFolder folder;
  const place::Route route = one_keyframe();
  folder.write("metrics.json", "of an earlier run");
  testing::internal::CaptureStdout();
  FollowResults results(route, folder.path());
  results.push(at_start(0, false), black(), {});
  results.push(at_start(1, true), black(), {});
  results.push(at_start(4, true), black(), {});
  EXPECT_FALSE(std::filesystem::exists(folder / "follow.jsonl"));
  EXPECT_TRUE(std::filesystem::exists(folder / "metrics.json"));
  results.finish({.walk = "night.mp4", .route = "route.db", .start_utc_s = {}, .warnings = {}}, {}, {});
  EXPECT_EQ(read_file(folder / "follow.jsonl"), testing::internal::GetCapturedStdout());
  for (const std::string& file : retrace::kFollowFiles)
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(folder / "metrics.json"));
  const std::string summary = read_file(folder / "summary.json");
  EXPECT_THAT(summary, HasSubstr(R"("query_frames": 3)"));
  EXPECT_THAT(summary, HasSubstr(R"("frames_on_route": 2)"));
  EXPECT_THAT(summary, HasSubstr(R"("query_duration_s": 2.0)"));
}

TEST(FollowResults, LeaveAFolderAsItWasWithoutAnEnd) {
  const TemporaryFolder folder;
  const place::Route route = one_keyframe();
  folder.write("metrics.json", "of an earlier run");
  testing::internal::CaptureStdout();
  FollowResults(route, folder.path()).push(at_start(0, true), black(), {});
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  EXPECT_EQ(read_file(folder / "metrics.json"), "of an earlier run");
}

}  // namespace
