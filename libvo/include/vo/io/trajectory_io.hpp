#pragma once

#include "vo/base/trajectory.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// What is true of every frame of a walk, from `truth.csv`, where it is known; all of one length, ordered by
/// frame.
struct WalkTruth {
  std::vector<std::int64_t> frame;  ///< 0, 1, 2, ... without a gap
  std::vector<double> time_s;
  std::vector<std::optional<Pose2>> pose;
  std::vector<std::optional<double>> distance_m;   ///< travelled along the route
  std::vector<std::optional<std::int64_t>> steps;  ///< cumulative; empty if the file has no such column
};

/// Reads `truth.csv`: columns frame,time_s,x_m,y_m,heading_deg,distance_m and optionally steps, in any order;
/// heading clockwise from +y. Beside frame and time, empty cells are what is not known; a pose is known with
/// all its three. Throws `vo::Error` naming file, line and column for a missing column, a cell that is no
/// number, frames that do not run 0, 1, 2, ..., times that do not increase or are not in seconds
/// (`time_unit`), or distances that decrease.
WalkTruth read_truth(const std::filesystem::path& path);

/// The known poses.
Trajectory poses_of(const WalkTruth& truth);

/// The poses of which the distance is known too, and these distances.
struct PosesAlongRoute {
  Trajectory poses;
  std::vector<double> distance_m;
};
PosesAlongRoute poses_along_route(const WalkTruth& truth);

/// The steps made in all: the last of the counts; none where none is known.
std::optional<std::int64_t> steps_in_all(const WalkTruth& truth);

/// The distance at each frame: where it is not known, on the straight line between those that are; before the
/// first and after the last, as there. Empty where none is known.
std::vector<double> distances_between(const WalkTruth& truth);

/// Reads a walk on the ground from a trajectory in retrace's own axes, the body's x forward, the world's z
/// up: `planar` of `read_pose_series`; z, roll and pitch are dropped. Throws as these do.
Trajectory read_tum(const std::filesystem::path& path);

/// A trajectory in TUM's form, microseconds and micrometres, after `comment` as a `#` line if there is one.
std::string to_tum(const Trajectory& trajectory, std::string_view comment = {});

}  // namespace vo
