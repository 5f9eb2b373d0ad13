#pragma once

#include "vo/io/pose_series_io.hpp"
#include "vo/motion/displacement_track.hpp"

#include <span>

namespace vo {

/// Settings of `external_trajectory`.
struct ExternalTrajectoryOptions {
  double start_s = 0;              ///< time on the file's clock at the first frame
  double time_tolerance_s = 0.02;  ///< largest time between a frame and a single pose, seconds
  /// Longest time between two poses that is interpolated, and between two frames of a segment, seconds.
  double max_gap_s = 0.5;
  bool metric = true;            ///< the file is in metres
  double relative_sigma = 0.02;  ///< standard deviation of a displacement, as a share: files do not give it
};

/// The track of a walk from another program's trajectory, matched by time.
///
/// A frame between two poses at most `max_gap_s` apart gets an interpolated pose (linear, and along the
/// shorter arc); one next to a gap, or at an end, gets the nearest pose if that is within the tolerance;
/// otherwise it is lost (`TrackLoss::kGap`). A new segment begins after a gap, but all share one unit
/// (`TrackScale::kMetric` or `kCommon`). A series without times has one pose for each frame.
///
/// `time_s`: of the frames, since the first, strictly increasing. Throws `vo::Error` naming the file if a
/// series without times has another number of poses than the walk has frames, if no frame has a pose, or if
/// none has a displacement although gaps are allowed; `std::invalid_argument` for options out of range.
/// O(frames log poses).
DisplacementTrack external_trajectory(const PoseSeries& series, std::span<const double> time_s,
                                      const ExternalTrajectoryOptions& options = {});

}  // namespace vo
