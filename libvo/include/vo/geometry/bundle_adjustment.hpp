#pragma once

#include "vo/base/pose3.hpp"
#include "vo/geometry/camera.hpp"

#include <cstddef>
#include <vector>

namespace vo {

/// Where a camera saw a point.
struct BundleObservation {
  std::size_t pose = 0;
  std::size_t point = 0;
  ImagePoint at;  ///< on the image plane
};

/// Cameras, points, and which camera saw which point where. Fixed ones are not changed.
struct Bundle {
  std::vector<Pose3> poses;
  std::vector<cv::Vec3d> points;
  std::vector<BundleObservation> observations;
  std::vector<bool> pose_fixed;   ///< one for each pose; empty: none is fixed
  std::vector<bool> point_fixed;  ///< one for each point; empty: none is fixed
  /// Radial distortion left in the observations: (x, y) is seen at (1 + radial r^2) (x, y); see
  /// `with_radial`.
  double radial = 0;
};

/// Settings of `adjust`.
struct BundleOptions {
  double noise = 1e-3;  ///< standard deviation of an observation, on the image plane
  int max_iterations = 10;
  double radial_mean = 0;   ///< expected radial distortion
  double radial_sigma = 0;  ///< its standard deviation; 0: not changed
};

/// Moves cameras and points to fit the observations best: least squares of the reprojection error with
/// Cauchy's weights at two standard deviations, by Levenberg and Marquardt (Triggs et al., "Bundle
/// adjustment, a modern synthesis", 2000). Returns false if the solver failed; the bundle is then unchanged.
/// Throws `std::invalid_argument` for indices out of range or a wrong number of flags. O(observations +
/// points + poses^3) per iteration; one thread.
bool adjust(Bundle& bundle, const BundleOptions& options = {});

/// Distance of each observation from its point's projection, on the image plane; infinite behind the camera.
std::vector<double> reprojection_errors(const Bundle& bundle);

}  // namespace vo
