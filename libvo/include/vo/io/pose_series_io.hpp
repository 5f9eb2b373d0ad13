#pragma once

#include "vo/base/pose3.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vo {

/// How the axes of a body lie in it.
enum class BodyAxes {
  kCamera,   ///< x right, y down, z forward: ORB-SLAM, stella_vslam, KITTI
  kVehicle,  ///< x forward, y left, z up: retrace's own trajectory.tum, ROS
  kNone,     ///< the file has no orientation
};

/// Poses in space from a file.
struct PoseSeries {
  std::string source;          ///< the file
  std::vector<double> time_s;  ///< strictly increasing, one for each pose; empty: one pose for each frame
  std::vector<Pose3> poses;    ///< world_from_body; the rotation says nothing with `BodyAxes::kNone`
  BodyAxes axes = BodyAxes::kCamera;
};

/// Reads a trajectory, by the number of cells in its first line:
///  - TUM: `time x y z qx qy qz qw`, separated by spaces;
///  - KITTI: the 12 numbers of a 3x4 matrix row by row, world_from_camera; times, if given, from a file of
///  one
///    number a line, as many as poses; otherwise it is one pose for each frame;
///  - CSV with a header: time_s,x_m,y_m and as far as they are there z_m, and qx,qy,qz,qw or heading_deg
///    (clockwise from +y).
/// `#` starts a comment. `axes`: those that TUM's and CSV's quaternions turn; KITTI's are a camera's, a
/// heading is a vehicle's. Throws `vo::Error` naming file and line for anything else, times that do not
/// increase, or a rotation that is none.
PoseSeries read_pose_series(const std::filesystem::path& path, BodyAxes axes = BodyAxes::kCamera,
                            const std::optional<std::filesystem::path>& kitti_times = std::nullopt);

/// Poses in TUM's form, those that are there, after `comment` as a `#` line. `time_s`: one for each pose,
/// else `std::invalid_argument`.
std::string to_tum(const std::vector<std::optional<Pose3>>& poses, const std::vector<double>& time_s,
                   std::string_view comment);

}  // namespace vo
