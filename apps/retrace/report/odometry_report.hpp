#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <place/evaluation/odometry_evaluation.hpp>
#include <vo/base/trajectory.hpp>

namespace retrace {

/// The truth of a walk's odometry, after evaluation.
struct OdometryTruth {
  vo::Trajectory poses;                   ///< with times; or else
  std::vector<place::MapPoint> map_path;  ///< a path on a map, metres
  std::filesystem::path map_image;        ///< the map, north up; empty: none
  double map_scale_m_per_px = 0;          ///< of the map
  std::string steps;                      ///< their number, for people; empty if not known
  place::OdometryEvaluation evaluation;
};

/// The report of a walk's odometry, from the files in its folder: trajectory.tum and, if present, frames.csv,
/// steps.csv, activity.csv, summary.json and config.toml; with the truth after evaluation. Throws `vo::Error`
/// for files that cannot be read, or a map image that is not an image.
std::string odometry_report(const std::filesystem::path& folder, const OdometryTruth* truth = nullptr);

}  // namespace retrace
