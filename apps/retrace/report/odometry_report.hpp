#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <place/evaluation/odometry_evaluation.hpp>
#include <vo/base/trajectory.hpp>

namespace retrace {

/// What is known of a walk's odometry once it was held against the truth.
struct OdometryTruth {
  vo::Trajectory poses;              ///< with times; or else
  std::vector<place::WayPoint> way;  ///< a way on a map, metres
  std::filesystem::path map_image;   ///< the map, north up; empty: none
  double map_scale_m_per_px = 0;     ///< of the map
  std::string steps;                 ///< how many, for people; empty if not known
  place::OdometryEvaluation evaluation;
};

/// The report of a walk's odometry, from the files in its folder: trajectory.tum, and where they are there
/// frames.csv, steps.csv, activity.csv, summary.json and config.toml; with the truth once it was evaluated.
/// Throws `vo::Error` for files that cannot be read, or a map image that is none.
std::string odometry_report(const std::filesystem::path& folder, const OdometryTruth* truth = nullptr);

}  // namespace retrace
