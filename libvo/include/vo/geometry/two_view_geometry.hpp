#pragma once

#include "vo/base/pose3.hpp"
#include "vo/geometry/camera.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vo {

/// The rotation of a camera between two views, assuming that it did not travel.
struct ViewRotation {
  cv::Matx33d rotation = cv::Matx33d::eye();  ///< first_from_second: the second camera's axes in the first's
  std::vector<double> off;  ///< each point's distance from where the turn puts it, on the image plane
};

/// The turn that explains most points best, by robust alignment of their rays (Cauchy's weights; Arun, Huang
/// and Blostein 1987 in each round). `from`, `to`: the same points on both image planes. Throws
/// `std::invalid_argument` for fewer than 2. `noise`: standard deviation of a point on the image plane.
/// O(points).
ViewRotation view_rotation(std::span<const ImagePoint> from, std::span<const ImagePoint> to, double noise);

/// The geometry of two views of one rigid scene.
struct TwoViewGeometry {
  bool planar = false;  ///< the homography explains the points better than the essential matrix
  Pose3 second;         ///< the second camera in the axes of the first; its position has length 1
  std::vector<std::optional<cv::Vec3d>> points;  ///< in the axes of the first; none where they do not fit
  std::size_t inliers = 0;                       ///< points that fit
  double parallax_rad = 0;                       ///< median angle between their rays to the two cameras
};

/// Settings of `two_view_geometry`.
struct TwoViewOptions {
  double noise = 1e-3;  ///< standard deviation of a point on the image plane
  std::size_t min_inliers = 30;
  int seed = 1;  ///< of the random samples
};

/// The motion of the camera between two views, up to its length, and the positions of the points.
///
/// Essential matrix and homography are both fitted (USAC; the same seed gives the same answer); the one with
/// the lower GRIC (Torr, "An assessment of information criteria for motion model selection", 1997) is
/// decomposed into rotation and translation, choosing the solution with most points in front of both cameras.
/// None if too few points fit, or a second solution is about as good.
///
/// `from`, `to`: the same points on both image planes; throws `std::invalid_argument` unless equally many.
std::optional<TwoViewGeometry> two_view_geometry(std::span<const ImagePoint> from,
                                                 std::span<const ImagePoint> to,
                                                 const TwoViewOptions& options = {});

}  // namespace vo
