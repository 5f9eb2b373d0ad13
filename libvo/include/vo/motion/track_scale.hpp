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
  double smoothing_s = 1;             ///< seconds, a stride: bounce and sway within it are no displacement
  double min_segment_s = 1;           ///< seconds; a shorter segment is left out
  double steps_window_s = 10;         ///< seconds over which steps tell the scale
  double ground_window_s = 20;        ///< seconds over which the ground holds it
  double steady_steps_window_s = 30;  ///< seconds over which steps tell it, where the ground holds it
  double max_disagreement = 0.5;      ///< of track and steps, as a share; a segment beyond is left out
  GroundHeightOptions ground;
  SegmentTieOptions tie;
  std::optional<double> camera_height_m;  ///< above the ground: metres without steps, where it is known
};

/// A track whose segments have one unit.
struct ScaledTrack {
  std::vector<std::optional<double>>
      displacement;        ///< of each frame; none where the track is lost or left out
  bool metric = false;     ///< metres; otherwise the unit of the first segment
  bool by_ground = false;  ///< the height of the camera tied at least one segment
};

/// Displacement of each frame along a track, in the unit of its segment: positions are averaged over
/// `smoothing_s` within their segment first (over less towards its ends), so that bounce and sway do not
/// count as way. None where the track is lost; without poses, the track's own displacements. O(frames *
/// window).
std::vector<std::optional<double>> smoothed_displacement(const DisplacementTrack& track,
                                                         std::span<const double> time_s, double smoothing_s);

/// Gives all segments of a track one unit.
///
/// Monocular visual odometry begins anew after each loss, with "displacement values scaled differently"
/// (SSS 5.2); SSS leaves it at that. Here:
///
/// 1. Within a segment, the ground seen in the seconds around each frame takes out the slow drift of a
///    monocular scale (`ground_height`): the camera keeps its height, whatever unit it is measured in.
/// 2. Where there are steps, each frame is scaled to metres by what steps and track say of the seconds around
///    it. A segment that steps contradict is left out.
/// 3. Without steps, the height of the camera ties a segment to those before it, the one of the possible
///    heights that continuity of speed and alignment error make likely (`segment_tie`), and those alone where
///    too little ground is seen.
///
/// A segment too short is left out. Tracks of a common unit are scaled as one segment, metric ones are left
/// as they are.
///
/// Throws `std::invalid_argument` for evidence without a track, or windows <= 0. O(frames * (window +
/// separations)).
ScaledTrack tie_track_scale(const MotionEvidence& evidence, const TrackScaleOptions& options = {});

}  // namespace vo
