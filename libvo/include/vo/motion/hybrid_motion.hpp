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
  kHeld,            ///< nothing could be seen: between the speeds before and after
};

/// "none", "vo", "steps", "sad", "held".
std::string_view name_of(DisplacementSource source);

/// How far the walker moved since the frame before.
struct FrameDisplacement {
  double value = 0;  ///< >= 0
  /// Standard deviation. Neighbouring frames of one source have similar errors: over a stretch the deviations
  /// add up, not their squares.
  double sigma = 0;
  DisplacementSource source = DisplacementSource::kNone;
};

/// Relative errors of steps and of alignment error over a second, for walks on which they cannot be measured.
inline constexpr double kUsualStepsError = 0.1;
inline constexpr double kUsualAlignmentError = 0.4;
/// Relative error of a length scaled by the camera's height above the ground (KITTI 03, every six seconds).
inline constexpr double kUsualGroundError = 0.03;

/// Settings of `hybrid_motion`.
struct HybridMotionOptions {
  TrackScaleOptions scale;
  double window_s = 20;  ///< seconds on either side of a loss that the relation is learned from [SSS 3]
  LearnedRelationOptions relation;
};

/// One displacement for each frame.
struct HybridMotion {
  std::vector<FrameDisplacement> frames;
  bool metric = false;  ///< in metres; otherwise in a unit of the track or seconds at the walk's mean speed
};

/// A displacement for every frame, from sources that each fail at times (SSS 3.5, 5.2, Fig. 9).
///
/// 1. The track is used where it works, in one unit (`tie_track_scale`): metres if there are steps.
/// 2. Where it is lost, steps or alignment error replace it, whichever was closer to it while it worked (SSS
///    has alignment error alone); the error is converted by its relation to displacement in the `window_s` on
///    either side. Where the view has not changed for long, the walker is still.
/// 3. Where neither shows anything (a black picture, a blank wall, a jump of the clock), the speed is
///    interpolated linearly between its means over a second before and after. Over a jump of more than
///    `kLongestFilledGap_s` it is 0.
///
/// Without a track, steps are used; without steps, alignment error over frame separation (SSS 3.2;
/// `estimate_motion`). sigma: for steps and alignment error, their root mean square difference from the track
/// over a second; for the track, that of its source of scale over its window; for held speed, how much speed
/// varies in the walk.
///
/// Throws `std::invalid_argument` if sizes disagree, or for fewer than two frames. O(frames * (separations +
/// window)).
HybridMotion hybrid_motion(const MotionEvidence& evidence, const HybridMotionOptions& options = {});

}  // namespace vo
