#pragma once

#include "vo/visual_odometry/ground_height.hpp"
#include "vo/visual_odometry/landmark_map.hpp"

#include <cstddef>
#include <vector>

namespace vo {

/// The direction in which the camera left a keyframe, up to a distance of `enough`; if it never got that far,
/// the direction in which it arrived, or the longest displacement there is. O(keyframes).
cv::Vec3d direction_at(const LandmarkMap& map, std::size_t keyframe, double enough);

/// How far a keyframe is above each landmark it sees that may be ground, see `heights_above`. Call it some
/// keyframes later, when the points that were new to it, mainly the nearest ground, have a position.
/// O(landmarks).
std::vector<double> keyframe_heights(const LandmarkMap& map, std::size_t keyframe, const cv::Vec3d& travelled,
                                     const GroundHeightOptions& options = {});

}  // namespace vo
