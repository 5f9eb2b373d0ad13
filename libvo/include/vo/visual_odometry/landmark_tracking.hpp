#pragma once

#include "vo/geometry/camera.hpp"
#include "vo/tracks/corner_grid.hpp"
#include "vo/tracks/klt_tracking.hpp"
#include "vo/visual_odometry/landmark_map.hpp"

#include <optional>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Adds landmarks at corners of the picture where there are none yet, as sightings of the last keyframe.
/// `grey`: its picture. See `grid_corners`.
void add_corners(LandmarkMap& map, const cv::Mat& grey, const Camera& camera,
                 const CornerGridOptions& options = {});

/// Tracks all landmarks seen in the picture before into the next; those not found are no longer tracked. The
/// search begins where `predicted`, the next camera, would see them; without it, or without a position, at
/// the last frame's displacement. See `follow`.
void follow_landmarks(LandmarkMap& map, const KltPyramid& before, const KltPyramid& after,
                      const Camera& camera, const std::optional<Pose3>& predicted,
                      const KltOptions& options = {});

/// The number of landmarks being tracked.
std::size_t followed_landmarks(const LandmarkMap& map);

}  // namespace vo
