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

/// A scene and a camera that is tracked through it.
struct TrackedScene {
  LandmarkMap map;
  std::vector<SegmentFrame> frames;  ///< from the first keyframe to the last frame that has a pose
  Pose3 pose;                        ///< of the last frame
  Pose3 motion;                      ///< of the last frame in the axes of the one before
  std::vector<double> speeds;        ///< displacements of the last frames
  double median_depth = 1;           ///< of the landmarks, at the last keyframe
  std::size_t keyframe_landmarks = 0;
  std::vector<std::vector<double>> heights;  ///< of the keyframes so far, above what may be ground
};

/// Settings of the functions below, described in `MonocularVoOptions`.
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

/// Tracks the landmarks from the picture of a scene's last frame to that of a later one, and finds the
/// camera's pose from them; a jump counts as lost. If lost, the scene is unchanged. O(landmarks).
LandmarkPose locate(TrackedScene& scene, std::size_t frame, const KltPyramid& last, const KltPyramid& next,
                    const Camera& camera, const SceneTrackingOptions& options);

/// Adds a located frame to the scene; frames skipped since the last one have no pose. Makes it a
/// keyframe if the camera has moved far enough or sees too few known landmarks: adds landmarks and adjusts
/// the last keyframes. `grey`: its picture.
void add_frame(TrackedScene& scene, std::size_t frame, const Resection& found, const cv::Mat& grey,
               const Camera& camera, const SceneTrackingOptions& options);

/// Prepares for the frames after a keyframe, which is the last frame: forgets landmarks that no longer matter
/// and adds others.
void renew_landmarks(TrackedScene& scene, const cv::Mat& grey, const Camera& camera,
                     const SceneTrackingOptions& options);

/// At the end of a scene, finds how high the remaining keyframes are above the ground.
void finish_heights(TrackedScene& scene, const SceneTrackingOptions& options);

/// True if the camera hardly moved in the last frames.
bool is_still(const TrackedScene& scene);

}  // namespace vo
