#pragma once

#include "vo/motion/learned_relation.hpp"
#include "vo/motion/motion_evidence.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vo {

/// Settings of `tie_track_scale`.
struct TrackScaleOptions {
  double smoothing_s = 1;         ///< seconds, a stride: bounce and sway within it are no displacement
  double min_segment_s = 1;       ///< seconds; a shorter segment is left out
  double steps_window_s = 10;     ///< seconds over which steps tell the scale
  double relation_window_s = 20;  ///< seconds before a loss, and after it, that tie one segment to the next
  double max_disagreement = 0.5;  ///< of track and steps, as a share; a segment beyond is left out
  LearnedRelationOptions relation;
};

/// A track whose segments have one unit.
struct ScaledTrack {
  std::vector<std::optional<double>>
      displacement;     ///< of each frame; none where the track is lost or left out
  bool metric = false;  ///< metres; otherwise the unit of the first segment
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
/// (SSS 5.2); SSS leaves it at that. Here, where there are steps, each frame is scaled to metres by what
/// steps and track say of the seconds around it, which holds the slow drift of a monocular scale as well.
/// Without steps, a segment is tied to those before it by the relation of alignment error and displacement
/// learned before the loss and read after it (SSS 3.5). A segment too short, or one that steps contradict, is
/// left out. Tracks of a common unit are scaled as one segment, metric ones are left as they are.
///
/// Throws `std::invalid_argument` for evidence without a track, or windows <= 0. O(frames * (window +
/// separations)).
ScaledTrack tie_track_scale(const MotionEvidence& evidence, const TrackScaleOptions& options = {});

}  // namespace vo
