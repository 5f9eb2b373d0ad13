#pragma once

#include "vo/base/pose3.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace vo {

/// Why a source of displacement has none for a frame.
enum class TrackLoss {
  kNone,           ///< it has one
  kTooFewCorners,  ///< too little can be followed from the frame before: dark, blurred, a blank wall
  kTooFewInliers,  ///< what can be followed does not move as one scene seen by one camera
  kLowParallax,    ///< it moved, but too little for depths before it went out of view
  kPoorSpread,     ///< all of it is in one part of the picture
  kJump,           ///< the motion found is none that a camera makes from one frame to the next
  kGap,            ///< no frame or no pose for too long
};

/// The loss as a word: "none", "too_few_corners", ...
std::string_view name_of(TrackLoss loss);

/// How a camera moved since the frame before.
struct TrackedDisplacement {
  bool valid = false;              ///< false: lost, and all below but `segment` and `loss` says nothing
  double displacement = 0;         ///< in the unit of its segment, >= 0; the first frame of a walk: 0
  double sigma = 0;                ///< its standard deviation, same unit
  std::optional<double> turn_rad;  ///< change of heading, clockwise from above; none where it is not known
  /// 0, 1, ..., never decreasing. After a loss the first frame that has a pose again is lost too, as how far
  /// it is from the frame before is not known. A new segment begins with it, unless the source found it in
  /// the unit of the one before. Lost frames without a pose belong to the segment before them. Where a camera
  /// turned on the spot away from all it knew, a new segment, with another unit, begins without a loss.
  int segment = 0;
  TrackLoss loss = TrackLoss::kNone;
};

/// How segments of one track compare in length.
enum class TrackScale {
  kPerSegment,  ///< each has a unit of its own, unrelated to the others' (monocular)
  kCommon,      ///< all have one unit, unknown (a monocular trajectory from a file)
  kMetric,      ///< all are in metres
};

/// One displacement for each frame of a walk, or a reason why there is none: by monocular visual odometry or
/// from a trajectory file.
struct DisplacementTrack {
  TrackScale scale = TrackScale::kPerSegment;
  std::vector<TrackedDisplacement> frames;
  /// One for each frame, in the unit of its segment; none where lost, or where the camera stood or turned
  /// before anything's depth was known. Of visual odometry each segment has a world of its own, the axes of
  /// its first camera; those of a file are the file's.
  std::vector<std::optional<Pose3>> poses;
  /// How high the camera is above what may be ground (`heights_above`), one list for each frame, in the unit
  /// of its segment; most are empty, and there are no lists at all where nothing is known of the scene.
  std::vector<std::vector<double>> heights;

  [[nodiscard]] std::size_t size() const { return frames.size(); }
};

}  // namespace vo
