#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include <vo/odometry.hpp>

namespace retrace {

/// Writes a walk's visual odometry: visual_odometry.csv, frame by frame, and visual_odometry.tum, the
/// camera's poses in units and axes of their segment.
void write_visual_odometry(const vo::Walk& walk, const std::filesystem::path& folder);

/// KITTI's errors of the longest segment in such files, scaled to metres by the first 50 m of the truth.
/// Throws `vo::Error` if there are no such files, or for a truth with another number of frames.
nlohmann::ordered_json kitti_metrics(const std::filesystem::path& folder,
                                     const std::filesystem::path& kitti_poses);

/// Those errors as a table, for people.
void print_kitti_metrics(const nlohmann::ordered_json& metrics);

}  // namespace retrace
