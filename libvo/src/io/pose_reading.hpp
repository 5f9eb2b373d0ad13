#pragma once

#include "io/pose_lines.hpp"
#include "vo/base/pose3.hpp"
#include "vo/io/time_unit.hpp"
#include "vo/io/trajectory_axes.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Poses as they stand in files, before they are put in order; private to `read_pose_series`.
namespace vo {

/// A pose as it stands in the file.
struct FilePose {
  double time = 0;        ///< in the file's own unit
  std::size_t frame = 0;  ///< position among the file's poses
  Pose3 pose;
};

/// What was read of a file, line by line.
struct Reading {
  std::vector<FilePose> poses;
  std::size_t lines = 0;
  std::size_t left_out = 0;
  std::string first_where, first_problem;  ///< of the lines left out
  std::size_t rescaled = 0;                ///< quaternions that were not of length 1
  std::optional<TimeUnit> unit;            ///< of times, if their column says so

  void leave_out(std::string where, std::string problem) {
    if (left_out++ == 0) {
      first_where = std::move(where);
      first_problem = std::move(problem);
    }
  }
};

/// The rotation of a quaternion of any length, counted if that is not 1; none for one of zeros.
std::optional<cv::Matx33d> from_quaternion(Reading& reading, double x, double y, double z, double w);

inline constexpr std::size_t kTumCells = 8, kKittiCells = 12;
Reading read_tum_lines(const NumberFile& file);
Reading read_kitti_lines(const NumberFile& file);

/// `axes` becomes those that a CSV file's columns leave no doubt of: a vehicle's with headings, none without
/// orientation.
Reading read_pose_csv(const std::filesystem::path& path, std::optional<FoundAxes>& axes);

}  // namespace vo
