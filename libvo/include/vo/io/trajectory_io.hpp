#pragma once

#include "vo/base/trajectory.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// What is true of every frame of a walk, from `truth.csv`; all of one length, ordered by frame.
struct WalkTruth {
  std::vector<std::int64_t> frame;  ///< 0, 1, 2, ... without a gap
  Trajectory poses;                 ///< one for each frame
  std::vector<double> distance_m;   ///< travelled along the route
  std::vector<std::int64_t> steps;  ///< cumulative; empty if the file has no such column
};

/// Reads `truth.csv`: columns frame,time_s,x_m,y_m,heading_deg,distance_m and optionally steps, in any order;
/// heading clockwise from +y. Throws `vo::Error` naming file, line and column for a missing column, a cell
/// that is no number, frames that do not run 0, 1, 2, ... or times that do not increase.
WalkTruth read_truth(const std::filesystem::path& path);

/// Reads a trajectory in TUM's form: lines of `time x y z qx qy qz qw`, seconds and metres, `#` starts a
/// comment. The walk is taken to be in the x-y plane, the body's x axis forward; z, roll and pitch are
/// dropped. Throws `vo::Error` naming file and line for anything else, or times that do not increase.
Trajectory read_tum(const std::filesystem::path& path);

/// A trajectory in TUM's form, microseconds and micrometres, after `comment` as a `#` line if there is one.
std::string to_tum(const Trajectory& trajectory, std::string_view comment = {});

}  // namespace vo
