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
  std::size_t min_points = 20;    ///< fewer points followed: lost
  std::size_t min_landmarks = 8;  ///< fewer landmarks where they should be: lost
  double min_inlier_share = 0.5;  ///< of the landmarks followed
  std::size_t min_cells = 4;      ///< of 6 x 4 over the picture, that the landmarks lie in
  int seed = 1;                   ///< of random samples
};

/// The pose of the camera from the landmarks in a picture, or why it is not known.
struct LandmarkPose {
  TrackLoss loss = TrackLoss::kNone;
  std::size_t landmarks = 0;  ///< followed, and with a position
  Resection found;            ///< of those; only if nothing is lost
};

/// The pose of the camera from the landmarks that are followed (`resection`); those that do not fit are
/// followed no longer. `predicted`: where it probably is; `picture`: its size. O(landmarks).
LandmarkPose pose_by_landmarks(LandmarkMap& map, const Pose3& predicted, cv::Size picture,
                               const LandmarkPoseOptions& options = {});

}  // namespace vo
