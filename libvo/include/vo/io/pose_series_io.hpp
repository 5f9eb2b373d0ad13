#pragma once

#include "vo/base/pose3.hpp"
#include "vo/base/trajectory.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vo {

/// How the axes of a body lie in it.
enum class BodyAxes {
  kCamera,   ///< x right, y down, z forward: ORB-SLAM, stella_vslam, KITTI
  kVehicle,  ///< x forward, y left, z up: retrace's own trajectory.tum, ROS
  kNone,     ///< the file has no orientation, or one that does not follow the path
};

/// The plane that a world's ground lies in.
enum class GroundPlane {
  kXY,       ///< z is up: maps, retrace's own trajectory.tum
  kXZ,       ///< y is down: the world is the first camera, x right and z forward
  kUnknown,  ///< neither the path nor the orientations show it
};

/// What is said of a trajectory's axes; see `find_axes` for what is found out.
enum class TrajectoryAxes {
  kAuto,     ///< found out from path and orientations
  kVehicle,  ///< the body's x forward and z up, the world's z up
  kCamera,   ///< the body's x right, y down and z forward; the world's y down, unless it is seen to be z up
};

/// Poses in space from a file.
struct PoseSeries {
  std::string source;              ///< the file
  std::vector<double> time_s;      ///< strictly increasing, one for each pose; empty: by `frame`
  std::vector<std::size_t> frame;  ///< where there are no times: the frame each pose is of, increasing
  std::size_t frames = 0;          ///< that a file without times is for
  std::vector<Pose3> poses;        ///< world_from_body; the rotation says nothing with `BodyAxes::kNone`
  BodyAxes axes = BodyAxes::kCamera;
  GroundPlane ground = GroundPlane::kUnknown;
  std::vector<std::string>
      warnings;  ///< what a user should know of the file: lines left out, clocks converted
};

/// Settings of `read_pose_series`.
struct PoseFileOptions {
  TrajectoryAxes axes = TrajectoryAxes::kAuto;
  std::optional<std::filesystem::path> kitti_times;  ///< one time in seconds a line, for KITTI's form
};

/// Reads a trajectory:
///  - TUM: lines of `time x y z qx qy qz qw`;
///  - KITTI: lines of the 12 numbers of a 3x4 matrix row by row, world_from_camera; one pose for each frame
///    unless times are given;
///  - CSV with a header, its columns known by the names that retrace (time_s,x_m,y_m and as far as they are
///    there z_m, and qx,qy,qz,qw or heading_deg, clockwise from +y), EuRoC (`#timestamp [ns],p_RS_R_x
///    [m],...`) and evo (timestamp,tx,...) give them.
/// Numbers are separated by spaces, commas, semicolons or tabs; `#` starts a comment; a first line of names
/// is skipped. Times in nano-, micro- or milliseconds, as a column's name or their size says, are
/// converted. Quaternions of any length are normalised. Lines out of order are sorted; lines that are no pose
/// (cells missing, NaN, a quaternion of zeros, a time that is there already) are left out. All of that is
/// said in `warnings`. Throws `vo::Error` naming the file, and the first bad line if most are bad; O(n log
/// n).
PoseSeries read_pose_series(const std::filesystem::path& path, const PoseFileOptions& options = {});

/// The walk that a series of poses with times shows on the ground: position on the ground plane, x east and y
/// north, and the heading of the body's forward axis; where the file has no orientation, that of the path
/// over `kPathHeading_m`. Throws `vo::Error` naming the file if its ground plane is unknown,
/// `std::invalid_argument` for a series without times.
Trajectory planar(const PoseSeries& series);

/// Poses in TUM's form, those that are there, after `comment` as a `#` line. `time_s`: one for each pose,
/// else `std::invalid_argument`.
std::string to_tum(const std::vector<std::optional<Pose3>>& poses, const std::vector<double>& time_s,
                   std::string_view comment);

}  // namespace vo
