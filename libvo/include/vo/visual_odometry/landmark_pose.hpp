#pragma once

#include "vo/geometry/resection.hpp"
#include "vo/motion/displacement_track.hpp"
#include "vo/visual_odometry/landmark_map.hpp"

#include <cstddef>

#include <opencv2/core/types.hpp>

namespace vo {

/// Settings of `pose_by_landmarks`.
struct LandmarkPoseOptions {
  double noise = 1e-3;            ///< standard deviation of a sighting on the image plane
  std::size_t min_points = 20;    ///< with fewer points tracked: lost
  std::size_t min_landmarks = 8;  ///< with fewer landmarks where they should be: lost
  double min_inlier_share = 0.5;  ///< of the landmarks tracked
  std::size_t min_cells = 4;      ///< of 6 x 4 over the picture that the landmarks lie in
  int seed = 1;                   ///< of random samples
};

/// The pose of the camera from the landmarks in a picture, or why it is unknown.
struct LandmarkPose {
  TrackLoss loss = TrackLoss::kNone;
  std::size_t landmarks = 0;  ///< tracked, and with a position
  Resection found;            ///< from those; only if not lost
};

/// The pose of the camera from the tracked landmarks (`resection`); those that do not fit are no longer
/// tracked. `predicted`: its probable pose; `picture`: the picture's size. O(landmarks).
LandmarkPose pose_by_landmarks(LandmarkMap& map, const Pose3& predicted, cv::Size picture,
                               const LandmarkPoseOptions& options = {});

}  // namespace vo
