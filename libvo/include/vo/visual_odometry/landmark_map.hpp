#pragma once

#include "vo/base/pose3.hpp"
#include "vo/geometry/camera.hpp"

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core/types.hpp>

namespace vo {

/// A point of the scene that is, or was, tracked from picture to picture.
struct Landmark {
  struct Sighting {
    std::size_t keyframe = 0;
    ImagePoint at;
  };
  bool followed = true;               ///< still seen in the last frame
  cv::Point2f pixel;                  ///< position in the last frame that saw it
  cv::Point2f flow{0, 0};             ///< displacement since the frame before
  ImagePoint at;                      ///< the same place on the image plane
  std::vector<Sighting> sightings;    ///< by keyframes, in order
  std::optional<cv::Vec3d> position;  ///< once known
};

/// A frame whose pose and sightings are kept.
struct Keyframe {
  std::size_t frame = 0;  ///< index in the walk
  Pose3 pose;
};

/// The scene seen since the odometry began or was last lost, in its own unit.
struct LandmarkMap {
  std::vector<Keyframe> keyframes;
  std::vector<Landmark> landmarks;
  double radial = 0;  ///< radial distortion left by calibration, removed from all image points here
};

/// Settings of the functions below.
struct LandmarkMapOptions {
  double noise = 1e-3;              ///< standard deviation of a sighting on the image plane
  double max_off = 3;               ///< standard deviations beyond which a sighting is dropped
  double min_parallax_rad = 0.012;  ///< between the rays to a landmark, for its position to be trusted
  std::size_t window = 8;           ///< keyframes adjusted together
  double radial_sigma = 0.02;       ///< standard deviation of the radial distortion left by calibration
  double radial_step = 0.002;       ///< and of its change in one adjustment; 0: it is not learned
};

/// Adds a keyframe and its sightings: all landmarks that are being tracked.
void add_keyframe(LandmarkMap& map, const Keyframe& keyframe);

/// Triangulates the tracked landmarks that have no position yet and were seen with enough parallax.
/// O(landmarks).
void place_landmarks(LandmarkMap& map, const LandmarkMapOptions& options);

/// Adjusts the last `window` keyframes and the landmarks they see, using the sightings of all keyframes;
/// earlier keyframes stay fixed (Mur-Artal et al. 2015, VI-D, "local bundle adjustment"). Then drops
/// sightings that do not fit, and landmarks with fewer than two left. Once there are keyframes before the
/// window, the radial distortion is adjusted too: what calibration leaves of it makes turns look like travel,
/// so that the scale drifts. See `adjust` for its cost.
void adjust_window(LandmarkMap& map, const LandmarkMapOptions& options);

/// Forgets landmarks that no longer matter: out of sight, and not seen by the window's keyframes.
void prune(LandmarkMap& map, const LandmarkMapOptions& options);

}  // namespace vo
