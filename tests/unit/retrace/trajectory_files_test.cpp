#include "trajectory_files.hpp"

#include "support/temporary_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/io/csv.hpp>
#include <vo/io/trajectory_io.hpp>

namespace {

using retrace::write_trajectory;
using test_support::read_file;
using test_support::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::vector<std::string> files_in(const TemporaryFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  return names;
}

/// A surveyed traverse and one whose poses are its own odometry.
place::Route route_on_earth() {
  place::Route route;
  route.origin = place::GeographicOrigin{.latitude_deg = 51.5, .longitude_deg = -0.25};
  route.traverses.resize(2);
  route.traverses[0].name = "day";
  route.traverses[1].name = "evening";
  route.traverses[1].surveyed = false;
  return route;
}

/// A match a second, at 10 m, 20 m, ... to the north; the last is not accepted.
std::vector<place::Match> three_matches(const std::string& traverse) {
  std::vector<place::Match> matches(3);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    matches[i].query_frame = static_cast<std::int64_t>(30 * i);
    matches[i].query_time_s = static_cast<double>(i);
    matches[i].place.emplace();
    matches[i].place->traverse = traverse;
    matches[i].place->pose = vo::Pose2{.x_m = 0, .y_m = 10.0 * static_cast<double>(i + 1), .heading_rad = 0};
    matches[i].probability = 0.5;
    matches[i].accepted = i < 2;
  }
  return matches;
}

place::QueryTrajectory uncorrected() {
  place::QueryTrajectory trajectory;
  trajectory.why_not = "there are too few matches";
  return trajectory;
}

TEST(TrajectoryFiles, WithoutCorrectionHaveThePlacesOfAcceptedMatches) {
  const TemporaryFolder folder;
  folder.write("trajectory.csv", "of another run");
  folder.write("trajectory_odometry.tum", "of another run");
  write_trajectory(uncorrected(), route_on_earth(), three_matches("day"), folder.path(), {});
  EXPECT_THAT(files_in(folder),
              UnorderedElementsAre("trajectory.tum", "trajectory.geojson", "trajectory.gpx"));
  const vo::Trajectory poses = vo::read_tum(folder / "trajectory.tum");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1].time_s, 1);
  EXPECT_NEAR(poses[1].pose.y_m, 20, 1e-6);
  EXPECT_THAT(read_file(folder / "trajectory.tum"), HasSubstr("there are too few matches"));
}

TEST(TrajectoryFiles, AreOnTheEarthOnlyWhereTheRouteWasSurveyed) {
  const TemporaryFolder folder;
  write_trajectory(uncorrected(), route_on_earth(), three_matches("evening"), folder.path(), {});
  EXPECT_THAT(files_in(folder), ElementsAre("trajectory.tum"));
  const TemporaryFolder nothing;
  write_trajectory(uncorrected(), route_on_earth(), {}, nothing.path(), {});
  EXPECT_THAT(files_in(nothing), ElementsAre("trajectory.tum"));
  EXPECT_THAT(read_file(nothing / "trajectory.tum"), HasSubstr("no pose: there are too few matches"));
}

TEST(TrajectoryFiles, WithCorrectionHaveEveryPoseAndItsUncertainty) {
  const TemporaryFolder folder;
  place::QueryTrajectory trajectory;
  trajectory.traverse = 0;
  for (int i = 0; i < 3; ++i) {
    const vo::Pose2 pose{.x_m = 1, .y_m = 10.0 * i, .heading_rad = 0};
    trajectory.odometry.push_back({static_cast<double>(i), pose});
    place::UncertainPose uncertain;
    uncertain.time_s = i;
    uncertain.pose = pose;
    uncertain.covariance[0] = 0.25;
    trajectory.corrected.poses.push_back(uncertain);
    trajectory.corrected.step_scale.push_back(1.5);
    trajectory.corrected.turn_scale.push_back(1);
    trajectory.on_route.emplace_back().distance_m = 10.0 * i;
  }
  trajectory.fixes.emplace_back().node = 1;
  trajectory.corrected.fix_weight = {0.75};
  write_trajectory(trajectory, route_on_earth(), three_matches("day"), folder.path(), {});
  EXPECT_THAT(files_in(folder),
              UnorderedElementsAre("trajectory.tum", "trajectory_odometry.tum", "trajectory.csv",
                                   "trajectory.geojson", "trajectory.gpx"));
  EXPECT_EQ(vo::read_tum(folder / "trajectory.tum").size(), 3U);
  const vo::CsvTable table = vo::CsvTable::read(folder / "trajectory.csv");
  EXPECT_THAT(table.numbers("query_frame"), ElementsAre(0, 30, 60));
  EXPECT_THAT(table.numbers("y_m"), ElementsAre(0, 10, 20));
  EXPECT_THAT(table.numbers("cov_xx_m2"), ElementsAre(0.25, 0.25, 0.25));
  EXPECT_THAT(table.numbers("distance_m"), ElementsAre(0, 10, 20));
  EXPECT_THAT(table.numbers("step_scale"), ElementsAre(1.5, 1.5, 1.5));
  // Only the second match was used, so the other cells are empty.
  const std::string csv = read_file(folder / "trajectory.csv");
  EXPECT_THAT(csv, HasSubstr(",0.7500\n"));
  EXPECT_THAT(csv, testing::EndsWith(",\n"));
}

}  // namespace
