#pragma once

#include "vo/io/pose_series_io.hpp"
#include "vo/motion/displacement_track.hpp"

#include <span>

namespace vo {

/// Settings of `external_trajectory`.
struct ExternalTrajectoryOptions {
  double start_s = 0;              ///< what the file's clock shows at the first frame
  double time_tolerance_s = 0.02;  ///< seconds by which a single pose and a frame may be apart
  double max_gap_s = 0.5;          ///< seconds between two poses beyond which nothing is known in between
  bool metric = true;              ///< the file is in metres
  double relative_sigma = 0.02;    ///< standard deviation of a displacement, as a share: files do not say it
};

/// The track of a walk from a trajectory of another program's, matched by time.
///
/// A frame between two poses not further apart than `max_gap_s` has the pose in between (linear, and along
/// the shorter arc); one beside a gap, or at an end, has the nearest pose if that is within the tolerance;
/// else it is lost (`TrackLoss::kGap`). After a gap a new segment begins, but all have one unit
/// (`TrackScale::kMetric` or `kCommon`): gaps end no scale. A series without times has one pose for each
/// frame.
///
/// `time_s`: of the frames, since the first, strictly increasing. Throws `vo::Error` naming the file if a
/// series without times has another number of poses, if no frame has a pose, or if none has a displacement
/// though gaps are allowed; `std::invalid_argument` for options out of range. O(frames log poses).
DisplacementTrack external_trajectory(const PoseSeries& series, std::span<const double> time_s,
                                      const ExternalTrajectoryOptions& options = {});

}  // namespace vo
