#pragma once

#include "vo/base/pose3.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vo {

/// Settings of `heights_above` and `ground_height`.
struct GroundHeightOptions {
  double max_ahead = 6;   ///< heights ahead of the camera; further off, slopes matter more than noise
  double spread = 0.05;   ///< standard deviation of one point's height, as a share: noise, bounce, grass
  double min_points = 8;  ///< that must agree on a height within the spread
};

/// The height expected before any ground is seen.
struct ExpectedHeight {
  double height = 1;
  double sigma = 0.3;  ///< standard deviation of its logarithm
};

/// How far a camera is above each of the points that may be ground: in front of it, below it, and not more
/// than `max_ahead` times as far off. Below is the camera's own y axis, made perpendicular to the direction
/// of travel: the ground that something walks or rolls on is parallel to its path, and cameras are carried
/// nearly level. `travel`: in the world's axes, of any length; none: no heights. O(points).
std::vector<double> heights_above(const Pose3& camera, const cv::Vec3d& travel,
                                  std::span<const cv::Vec3d> points, const GroundHeightOptions& options = {});

/// The height that most points agree on: the highest peak of their density over the logarithm of height,
/// a normal kernel of `spread`. None if too few agree. Points above the ground lie at all heights, those on
/// it at one, so they need not be the majority. Where the height is `expected` somewhere, the density is
/// weighed by how likely that makes it, so that a hedge is not taken for the ground.
///
/// This makes lengths comparable where nothing else does: a camera that is carried or driven keeps its
/// height, so the height shows how long each unit that monocular odometry takes on is (Kitt, Rehder,
/// Chambers, Schoenbein, Lategahn and Stiller 2011, "Monocular visual odometry using a planar road model to
/// solve scale ambiguity"). O(heights^2) at worst.
std::optional<double> ground_height(std::span<const double> heights,
                                    const std::optional<ExpectedHeight>& expected = {},
                                    const GroundHeightOptions& options = {});

}  // namespace vo
