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
  kTooFewCorners,  ///< too little can be tracked from the frame before: dark, blurred, a blank wall
  kTooFewInliers,  ///< what can be tracked does not move as one scene seen by one camera
  kLowParallax,    ///< it left the view before it had moved enough for depths
  kPoorSpread,     ///< all points are in one part of the picture
  kJump,           ///< no camera makes the motion found from one frame to the next
  kGap,            ///< no frame or no pose for too long
};

/// The loss as a word: "none", "too_few_corners", ...
std::string_view name_of(TrackLoss loss);

/// How a camera moved since the frame before.
struct TrackedDisplacement {
  bool valid = false;              ///< false: lost, and only `segment` and `loss` have a meaning
  double displacement = 0;         ///< in the unit of its segment, >= 0; the first frame of a walk: 0
  double sigma = 0;                ///< its standard deviation, same unit
  std::optional<double> turn_rad;  ///< change of heading, clockwise from above; none where it is not known
  /// 0, 1, ..., never decreasing. After a loss, the first frame with a pose counts as lost too, as its
  /// distance from the frame before is not known. It begins a new segment, unless the source found it in the
  /// unit of the segment before. Lost frames without a pose belong to the segment before them. Where a camera
  /// turns on the spot away from all known points, a new segment, with another unit, begins without a loss.
  int segment = 0;
  TrackLoss loss = TrackLoss::kNone;
};

/// How segments of one track compare in length.
enum class TrackScale {
  kPerSegment,  ///< each has its own unit, unrelated to the others' (monocular)
  kCommon,      ///< all share one unknown unit (a monocular trajectory from a file)
  kMetric,      ///< all are in metres
};

/// One displacement per frame of a walk, or the reason for having none: from monocular visual odometry or a
/// trajectory file.
struct DisplacementTrack {
  TrackScale scale = TrackScale::kPerSegment;
  std::vector<TrackedDisplacement> frames;
  /// One for each frame, in the unit of its segment; none where lost, or where the camera was still or turned
  /// before any depth was known. In visual odometry each segment has its own world, the axes of its first
  /// camera; poses from a file keep the file's world.
  std::vector<std::optional<Pose3>> poses;
  /// How high the camera is above what may be ground (`heights_above`), one list for each frame, in the unit
  /// of its segment; most are empty, and there are no lists at all if nothing is known about the scene.
  std::vector<std::vector<double>> heights;

  [[nodiscard]] std::size_t size() const { return frames.size(); }
};

}  // namespace vo
