#pragma once

#include "vo/geometry/camera.hpp"
#include "vo/tracks/corner_grid.hpp"
#include "vo/tracks/klt_tracking.hpp"
#include "vo/visual_odometry/ground_height.hpp"
#include "vo/visual_odometry/landmark_map.hpp"
#include "vo/visual_odometry/landmark_pose.hpp"
#include "vo/visual_odometry/track_segment.hpp"

#include <cstddef>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// A scene and a camera that is followed through it.
struct TrackedScene {
  LandmarkMap map;
  std::vector<SegmentFrame> frames;  ///< from the first keyframe to the last frame that has a pose
  Pose3 pose;                        ///< of the last frame
  Pose3 motion;                      ///< of the last frame in the axes of the one before
  std::vector<double> speeds;        ///< displacements of the last frames
  double median_depth = 1;           ///< of the landmarks, at the last keyframe
  std::size_t keyframe_landmarks = 0;
  std::vector<std::vector<double>> heights;  ///< of keyframes above what may be ground, so far
};

/// Settings of the functions below; `MonocularVoOptions` says what they mean.
struct SceneTrackingOptions {
  LandmarkMapOptions map;
  LandmarkPoseOptions pose;
  CornerGridOptions corners;
  KltOptions klt;
  GroundHeightOptions ground;
  double keyframe_travel = 0.08;
  double keyframe_share = 0.7;
  double max_turn_rad = 0.35;
  double max_speedup = 5;
};

/// Follows the landmarks from the picture of a scene's last frame to that of a later one, and finds the
/// camera by them; a jump counts as lost. If it is lost, the scene is as it was. O(landmarks).
LandmarkPose locate(TrackedScene& scene, std::size_t frame, const KltPyramid& last, const KltPyramid& next,
                    const Camera& camera, const SceneTrackingOptions& options);

/// Adds a located frame to the scene; frames left out since the last one have no pose. Makes it a
/// keyframe where the camera has moved on, or sees too little of what it knew: adds landmarks, and adjusts
/// the last ones. `grey`: its picture.
void go_on(TrackedScene& scene, std::size_t frame, const Resection& found, const cv::Mat& grey,
           const Camera& camera, const SceneTrackingOptions& options);

/// Prepares for the frames after a keyframe, which is the last frame: forgets landmarks that no longer
/// matter, adds others.
void renew_landmarks(TrackedScene& scene, const cv::Mat& grey, const Camera& camera,
                     const SceneTrackingOptions& options);

/// Finds how high the remaining keyframes are above the ground, when the scene ends.
void finish_heights(TrackedScene& scene, const SceneTrackingOptions& options);

/// True if the camera hardly moved in the last frames.
bool stands(const TrackedScene& scene);

}  // namespace vo
