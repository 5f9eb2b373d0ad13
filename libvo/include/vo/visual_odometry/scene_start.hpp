#pragma once

#include "vo/visual_odometry/landmark_map.hpp"
#include "vo/visual_odometry/track_segment.hpp"

#include <cstddef>
#include <vector>

namespace vo {

/// A frame of a new scene that has no landmarks with a position yet.
struct WaitingFrame {
  struct Seen {
    std::size_t landmark = 0;
    ImagePoint at;
  };
  std::size_t frame = 0;                      ///< index in the walk
  std::vector<Seen> seen;                     ///< the tracked landmarks
  cv::Matx33d rotation = cv::Matx33d::eye();  ///< first_from_this, assuming the camera only turned
  double off = 0;  ///< median distance of points from where that turn puts them, on the image plane
};

/// The current frame's view of the landmarks that the first keyframe saw. Throws `std::invalid_argument` if
/// fewer than 2 are tracked.
WaitingFrame waiting_frame(const LandmarkMap& map, std::size_t frame, double noise);

/// Settings of `begin_scene`.
struct SceneStartOptions {
  double min_parallax_rad = 0.017;  ///< median, between the rays of the first keyframe and the last frame
  std::size_t min_landmarks = 30;   ///< that the two views must agree on
  std::size_t min_seen = 12;        ///< of these, for the pose of a frame in between
  int seed = 1;                     ///< of random samples
};

/// Triangulates the first landmarks from the first keyframe and the last waiting frame, which becomes a
/// keyframe (`two_view_geometry`); their median depth is the unit of length. Then adjusts both and finds the
/// poses in between. Returns the segment so far, from the first keyframe to the last frame. If the geometry
/// of the views is ambiguous or the parallax too small, it is empty and the map is unchanged.
std::vector<SegmentFrame> begin_scene(LandmarkMap& map, const std::vector<WaitingFrame>& waiting,
                                      const LandmarkMapOptions& map_options,
                                      const SceneStartOptions& options);

/// True if the camera was still or only turned in the waiting frames: their points moved as one, for
/// `seconds` or over a turn in which those of a moving camera would not have.
bool stood_or_turned(const std::vector<WaitingFrame>& waiting, double seconds, double noise);

}  // namespace vo
