#pragma once

#include "arguments.hpp"
#include "measured_odometry.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace retrace {

/// The truth of the walks whose odometry is evaluated.
struct OdometryTruths {
  std::string kitti_poses;         ///< of one walk's visual odometry; or else
  std::vector<std::string> paths;  ///< of each walk: truth.csv, or a path on a map
  std::optional<double> map_scale_m_per_px;
  std::string map_image;
  std::vector<std::size_t> true_steps;  ///< of each walk, or none
};

/// Returns --kitti-poses, beside which other options have no effect.
Argument declare_odometry_truths(Arguments& arguments, OdometryTruths& truths);

/// What each of the walks is compared with; none with poses in KITTI's form. Throws `vo::Error` unless there
/// is as much as there are walks.
std::vector<WalkTruthOptions> truth_of_each(const OdometryTruths& truths, std::size_t walks);

}  // namespace retrace
