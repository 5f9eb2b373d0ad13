#pragma once

#include "vo/base/pose3.hpp"
#include "vo/geometry/camera.hpp"

#include <cstddef>
#include <optional>
#include <vector>

#include <opencv2/core/types.hpp>

namespace vo {

/// A point of the scene that is, or was, followed from picture to picture.
struct Landmark {
  struct Sighting {
    std::size_t keyframe = 0;
    ImagePoint at;
  };
  bool followed = true;               ///< seen in the last frame, too
  cv::Point2f pixel;                  ///< where, in the last frame that saw it
  cv::Point2f flow{0, 0};             ///< displacement since the frame before
  ImagePoint at;                      ///< the same place on the image plane
  std::vector<Sighting> sightings;    ///< by keyframes, in order
  std::optional<cv::Vec3d> position;  ///< once it is known
};

/// A frame whose pose and sightings are kept.
struct Keyframe {
  std::size_t frame = 0;  ///< index in the walk
  Pose3 pose;
};

/// What was seen of the scene since the odometry began or was last lost, in a unit of its own.
struct LandmarkMap {
  std::vector<Keyframe> keyframes;
  std::vector<Landmark> landmarks;
  double radial = 0;  ///< radial distortion that calibration left over, taken out of all image points here
};

/// Settings of the functions below.
struct LandmarkMapOptions {
  double noise = 1e-3;              ///< standard deviation of a sighting on the image plane
  double max_off = 3;               ///< standard deviations beyond which a sighting is dropped
  double min_parallax_rad = 0.012;  ///< between the rays to a landmark, before its position is trusted
  std::size_t window = 8;           ///< keyframes that are adjusted together
  double radial_sigma = 0.02;       ///< standard deviation of what calibration leaves of radial distortion
  double radial_step = 0.002;       ///< and of what one adjustment changes of it; 0: it is not learned
};

/// Adds a keyframe, and what it sees: all landmarks that are followed.
void add_keyframe(LandmarkMap& map, const Keyframe& keyframe);

/// Places the followed landmarks that have none yet and were seen under enough parallax. O(landmarks).
void place_landmarks(LandmarkMap& map, const LandmarkMapOptions& options);

/// Adjusts the last `window` keyframes and the landmarks they see, as those and the keyframes before them saw
/// them; those before stay (Mur-Artal et al. 2015, VI-D, "local bundle adjustment"). Then drops sightings
/// that do not fit, with the landmarks that do not have two left. Once there are keyframes before the window,
/// the radial distortion is adjusted as well: what a calibration leaves of it makes turns look like travel,
/// and so the scale drift. See `adjust` for its cost.
void adjust_window(LandmarkMap& map, const LandmarkMapOptions& options);

/// Forgets landmarks that no longer matter: out of sight, and not seen by the keyframes of the window.
void prune(LandmarkMap& map, const LandmarkMapOptions& options);

}  // namespace vo
