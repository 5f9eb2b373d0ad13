#pragma once

#include "vo/base/pose3.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vo {

/// Settings of `heights_above` and `ground_height`.
struct GroundHeightOptions {
  double max_ahead = 6;   ///< in heights ahead of the camera; further away, slopes matter more than noise
  double spread = 0.05;   ///< standard deviation of one point's height, as a share: noise, bounce, grass
  double min_points = 8;  ///< that must agree on a height, within the spread
};

/// The height expected before any ground is seen.
struct ExpectedHeight {
  double height = 1;
  double sigma = 0.3;  ///< standard deviation of its logarithm
};

/// How far a camera is above each point that may be ground: in front of it, below it, and at most `max_ahead`
/// times that height away. Down is the camera's own y axis, made perpendicular to the direction of travel:
/// the ground is parallel to the path of anything that walks or rolls on it, and cameras are carried nearly
/// level. `travel`: in the world's axes, of any length; zero gives no heights. O(points).
std::vector<double> heights_above(const Pose3& camera, const cv::Vec3d& travel,
                                  std::span<const cv::Vec3d> points, const GroundHeightOptions& options = {});

/// The height that most points agree on: the highest peak of their density over the logarithm of height, with
/// a normal kernel of width `spread`. None if too few agree. Points above the ground lie at all heights and
/// those on it at one, so ground points need not be the majority. An `expected` height weights the density by
/// its likelihood, so that a hedge is not taken for the ground.
///
/// This makes lengths comparable where nothing else does: a carried or driven camera keeps its height, which
/// shows how long each unit of monocular odometry is (Kitt, Rehder, Chambers, Schoenbein, Lategahn and
/// Stiller 2011, "Monocular visual odometry using a planar road model to solve scale ambiguity"). At worst
/// O(heights^2).
std::optional<double> ground_height(std::span<const double> heights,
                                    const std::optional<ExpectedHeight>& expected = {},
                                    const GroundHeightOptions& options = {});

}  // namespace vo
