#pragma once

#include "vo/motion/hybrid_motion.hpp"
#include "vo/motion/motion_source.hpp"
#include "vo/odometry.hpp"

#include <optional>
#include <string>
#include <vector>

namespace vo {

/// Settings of `walk_motion`.
struct WalkMotionOptions {
  VisualMotionOptions visual;
  PedestrianMotionOptions pedestrian;
  HybridMotionOptions hybrid;
};

/// One displacement for each frame of a walk, whatever it comes from.
struct WalkMotion {
  std::vector<FrameDisplacement> frames;
  bool metric = false;                         ///< metres; otherwise as `HybridMotion` and `VisualMotion` say
  std::optional<VisualMotion> visual;          ///< where alignment error was asked for
  std::optional<PedestrianMotion> pedestrian;  ///< where steps were asked for
  Trajectory trajectory;  ///< from (0, 0), heading 0, in that unit; empty unless headings are known
  std::vector<std::string> warnings;  ///< what a user should know of it
};

/// Has `read_walk` keep what `walk_motion` needs for a source.
void keep_for(MotionSource source, WalkOptions& options);

/// The displacement of every frame by one source, or by all of them (`hybrid_motion`).
///
/// `kHybrid` takes what the walk was read with, and does without steps where the frame rate is too low to see
/// any, or where they were found during less than half of the time that the camera is seen to move. Steps
/// that would have the camera nearer to the ground, or higher, than one that is carried (`height_by_steps_m`)
/// are none: there, `pedestrian` has no steps. A camera that never leaves its first view, and sees no steps,
/// stands: its displacements are 0. `kFile` is the same without steps, with the track of a file.
/// `kVisualOdometry` is the track as it is: nothing where it is lost, each segment in a unit of its own.
/// Where points were followed, slow motion and time lapses are warned of (`impossible_cadence_hz`).
///
/// Throws `std::invalid_argument` for `kNone`, or a walk that was not read with what the source needs;
/// `vo::Error` naming a walk that shows no motion to learn from, for `kSad`. A walk without steps has, by
/// `kSteps`, displacements of 0 from no source.
WalkMotion walk_motion(const Walk& walk, MotionSource source, const WalkMotionOptions& options = {});

/// The motion of a walker whose steps are wanted: by `source`, `kHybrid` or `kSteps`; by steps alone, with a
/// warning, where the others show nothing, and without one where too few frames a second show no steps.
/// Throws as `walk_motion` and `pedestrian_motion` do.
WalkMotion motion_with_steps(const Walk& walk, MotionSource source, const WalkMotionOptions& options = {});

/// The values alone, as the sampler takes them.
std::vector<double> displacements(const WalkMotion& motion);

}  // namespace vo
