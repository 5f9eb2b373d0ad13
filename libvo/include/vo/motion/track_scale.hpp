#pragma once

#include "vo/motion/motion_evidence.hpp"
#include "vo/motion/segment_tie.hpp"
#include "vo/visual_odometry/ground_height.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vo {

/// Settings of `tie_track_scale`.
struct TrackScaleOptions {
  double smoothing_s = 1;             ///< seconds, a stride: bounce and sway within it are not displacement
  double min_segment_s = 1;           ///< seconds; a shorter segment is left out
  double steps_window_s = 10;         ///< seconds over which steps give the scale
  double ground_window_s = 20;        ///< seconds over which the ground keeps it steady
  double steady_steps_window_s = 30;  ///< seconds over which steps give it, where the ground keeps it steady
  double max_disagreement = 0.5;      ///< of track and steps, as a share; a segment with more is left out
  GroundHeightOptions ground;
  SegmentTieOptions tie;
  std::optional<double> camera_height_m;  ///< above the ground, if known: gives metres without steps
};

/// A track whose segments share one unit.
struct ScaledTrack {
  std::vector<std::optional<double>>
      displacement;        ///< of each frame; none where the track is lost or left out
  bool metric = false;     ///< metres; otherwise the unit of the first segment
  bool by_ground = false;  ///< the height of the camera tied at least one segment
};

/// Displacement of each frame along a track, in the unit of its segment: positions are averaged over
/// `smoothing_s` within their segment first (over less towards its ends), so that bounce and sway do not
/// count as distance. None where the track is lost; without poses, the track's own displacements. O(frames *
/// window).
std::vector<std::optional<double>> smoothed_displacement(const DisplacementTrack& track,
                                                         std::span<const double> time_s, double smoothing_s);

/// Converts all segments of a track to one unit.
///
/// Monocular visual odometry starts again after each loss, with "displacement values scaled differently" (SSS
/// 5.2); SSS does nothing about it. Here:
///
/// 1. Within a segment, the ground seen in the seconds around each frame removes the slow drift of a
///    monocular scale (`ground_height`): the camera keeps its height, whatever the unit.
/// 2. Where there are steps, each frame is scaled to metres by the steps and the track in the seconds around
///    it. A segment that steps contradict is left out.
/// 3. Without steps, the height of the camera ties a segment to those before it: the candidate height that
///    continuity of speed and alignment error make most likely (`segment_tie`). Where too little ground is
///    seen, only those two are used.
///
/// Segments that are too short are left out. Tracks with a common unit are scaled as one segment; metric ones
/// are unchanged.
///
/// Throws `std::invalid_argument` for evidence without a track, or windows <= 0. O(frames * (window +
/// separations)).
ScaledTrack tie_track_scale(const MotionEvidence& evidence, const TrackScaleOptions& options = {});

}  // namespace vo
