#pragma once

#include "vo/geometry/camera.hpp"
#include "vo/tracks/corner_grid.hpp"
#include "vo/tracks/klt_tracking.hpp"
#include "vo/visual_odometry/landmark_map.hpp"

#include <optional>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Adds landmarks to follow where the picture has corners and none yet, as the last keyframe sees them.
/// `grey`: its picture. See `grid_corners`.
void add_corners(LandmarkMap& map, const cv::Mat& grey, const Camera& camera,
                 const CornerGridOptions& options = {});

/// Follows all landmarks that were seen in the picture before into the next; those not found are no longer
/// followed. They are looked for where `predicted`, the next camera, would see them; without it, or without a
/// position, the displacement of the last frame is assumed again. See `follow`.
void follow_landmarks(LandmarkMap& map, const KltPyramid& before, const KltPyramid& after,
                      const Camera& camera, const std::optional<Pose3>& predicted,
                      const KltOptions& options = {});

/// How many are followed.
std::size_t followed_landmarks(const LandmarkMap& map);

}  // namespace vo
