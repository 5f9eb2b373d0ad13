#pragma once

#include "vo/motion/displacement_track.hpp"
#include "vo/visual_odometry/landmark_map.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace vo {

/// A pose relative to a keyframe, which follows the keyframe's adjustments.
struct AnchoredPose {
  std::size_t keyframe = 0;
  Pose3 in_keyframe;  ///< keyframe_from_camera
};

/// A frame of a segment that is still being adjusted.
struct SegmentFrame {
  std::size_t frame = 0;               ///< index in the walk
  std::optional<AnchoredPose> before;  ///< by the keyframe before it, or its own; none: its pose is not known
  std::optional<AnchoredPose> after;   ///< by the one after it, once there is one
  double sigma = 0;                    ///< of its displacement
};

/// Writes the frames of a segment into the track once its keyframes are final: the pose of a frame between
/// two keyframes is interpolated between the poses from both, by its distance in frames. The first frame of a
/// segment keeps its entry in the track if it also belongs to the segment before. `frames`: consecutive, all
/// in the track.
void write_segment(std::span<const SegmentFrame> frames, const std::vector<Keyframe>& keyframes, int segment,
                   DisplacementTrack& track);

/// Change of heading of a camera, to the right.
double heading_change_rad(const cv::Matx33d& from, const cv::Matx33d& to);

}  // namespace vo
