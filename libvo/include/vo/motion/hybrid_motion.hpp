#pragma once

#include "vo/motion/learned_relation.hpp"
#include "vo/motion/motion_evidence.hpp"
#include "vo/motion/track_scale.hpp"

#include <string_view>
#include <vector>

namespace vo {

/// What the displacement of a frame comes from.
enum class DisplacementSource {
  kNone,            ///< the first frame has none
  kTrack,           ///< visual odometry, or a trajectory from a file
  kSteps,           ///< steps [PVO]
  kAlignmentError,  ///< alignment error, through a learned relation [SSS]
  kHeld,            ///< nothing was to be seen: between the speeds before and after
};

/// "none", "vo", "steps", "sad", "held".
std::string_view name_of(DisplacementSource source);

/// How far the walker moved since the frame before.
struct FrameDisplacement {
  double value = 0;  ///< >= 0
  /// Standard deviation. The errors of neighbouring frames of one source are alike: over a stretch they add
  /// up, not their squares.
  double sigma = 0;
  DisplacementSource source = DisplacementSource::kNone;
};

/// Relative errors over a second of steps and of alignment error, for walks on which they cannot be measured.
inline constexpr double kUsualStepsError = 0.1;
inline constexpr double kUsualAlignmentError = 0.4;
/// Relative error of a length told by the camera's height above the ground (KITTI 03, every six seconds).
inline constexpr double kUsualGroundError = 0.03;

/// Settings of `hybrid_motion`.
struct HybridMotionOptions {
  TrackScaleOptions scale;
  double window_s = 20;  ///< seconds either side of a loss that the relation is learned from [SSS 3]
  LearnedRelationOptions relation;
};

/// One displacement for each frame.
struct HybridMotion {
  std::vector<FrameDisplacement> frames;
  bool metric = false;  ///< metres; otherwise some unit of the track's, or seconds at the walk's mean speed
};

/// One continuous displacement per frame from sources that each fail at times (SSS 3.5, 5.2, Fig. 9).
///
/// 1. The track counts where it works, in one unit (`tie_track_scale`): metres, where there are steps.
/// 2. Where it is lost, steps or alignment error stand in, whichever was closer to it while it worked (SSS
///    has alignment error alone), the error by what it meant for displacement in the `window_s` on either
///    side. Where the view has long not changed, the walker stands.
/// 3. Where neither says anything (a black picture, a blank wall, a jump of the clock), the speed goes in a
///    straight line from what it was over a second before to what it is after. Over a jump of more than
///    `kLongestFilledGap_s` it is 0.
///
/// Without a track it is steps; without them, alignment error over frame separation (SSS 3.2), as
/// `estimate_motion` has it. sigma: for steps and alignment error, their root mean square difference to the
/// track over a second; for the track, that of what its scale was tied by over its window; for speed held,
/// how much speed varies in the walk.
///
/// Throws `std::invalid_argument` if sizes disagree, or for fewer than two frames. O(frames * (separations +
/// window)).
HybridMotion hybrid_motion(const MotionEvidence& evidence, const HybridMotionOptions& options = {});

}  // namespace vo
