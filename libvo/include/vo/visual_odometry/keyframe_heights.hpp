#pragma once

#include "vo/visual_odometry/ground_height.hpp"
#include "vo/visual_odometry/landmark_map.hpp"

#include <cstddef>
#include <vector>

namespace vo {

/// The direction in which the camera left a keyframe, until it was `enough` away from it; if it did not get
/// so far, the direction it came in, or the longest stretch there is. O(keyframes).
cv::Vec3d way_at(const LandmarkMap& map, std::size_t keyframe, double enough);

/// How far a keyframe is above each of the landmarks it sees that may be ground, see `heights_above`. Known
/// only some keyframes later, when points that were new to it have a position, the nearest ground above all.
/// O(landmarks).
std::vector<double> keyframe_heights(const LandmarkMap& map, std::size_t keyframe, const cv::Vec3d& way,
                                     const GroundHeightOptions& options = {});

}  // namespace vo
