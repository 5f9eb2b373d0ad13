#pragma once

#include "vo/base/pose3.hpp"
#include "vo/geometry/camera.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vo {

/// Settings of `resection`.
struct ResectionOptions {
  double noise = 1e-3;     ///< standard deviation of a point on the image plane
  double max_off = 3;      ///< standard deviations beyond which a point does not fit
  double min_share = 0.5;  ///< least share of points that fit; with fewer, random samples are tried
  int seed = 1;            ///< of the random samples
};

/// The pose of a camera that sees known points.
struct Resection {
  Pose3 camera;
  std::vector<bool> fits;   ///< one for each point
  std::size_t inliers = 0;  ///< number of points that fit
  /// Covariance of the position from the points that fit, row by row; zero if it cannot be computed.
  cv::Matx33d position_covariance = cv::Matx33d::zeros();
};

/// The pose from which the points of the world appear at `seen`: robust least squares from `start`
/// (`adjust`), and if too few fit, from the best of random samples (P3P within USAC). Throws
/// `std::invalid_argument` unless `points` and `seen` are equally many. With fewer than 4 the result is
/// `start`, and none fit. O(points).
Resection resection(std::span<const cv::Vec3d> points, std::span<const ImagePoint> seen, const Pose3& start,
                    const ResectionOptions& options = {});

/// Standard deviation, in the direction `along`, of a displacement whose ends are both as uncertain as this
/// camera. `along`: of any length; 0 for length 0.
double displacement_sigma(const Resection& found, const cv::Vec3d& along);

}  // namespace vo
