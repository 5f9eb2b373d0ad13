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

/// One displacement for each frame of a walk, from any source.
struct WalkMotion {
  std::vector<FrameDisplacement> frames;
  bool metric = false;                         ///< in metres; else as in `HybridMotion` and `VisualMotion`
  std::optional<VisualMotion> visual;          ///< where alignment error was asked for
  std::optional<PedestrianMotion> pedestrian;  ///< where steps were asked for
  Trajectory trajectory;  ///< from (0, 0), heading 0, in that unit; empty unless headings are known
  std::optional<double> impossible_cadence_hz;  ///< if its clock is not the walker's
  std::vector<std::string> warnings;            ///< what a user should know
};

/// Makes `read_walk` keep what `walk_motion` needs for a source.
void keep_for(MotionSource source, WalkOptions& options);

/// The displacement of every frame by one source, or by all of them (`hybrid_motion`).
///
/// `kHybrid` uses whatever the walk was read with. It ignores steps if the frame rate is too low to see any,
/// or if they were found during less than half of the time that the camera is seen to move. Steps that put
/// the camera lower or higher than people carry one (`height_by_steps_m`) are not steps: then `pedestrian`
/// has none. A camera that never leaves its first view, and sees no steps, is still: its displacements are 0.
/// `kFile` is the same without steps, with the track of a file. `kHybridAsPublished` is
/// `hybrid_as_published`, each segment in a unit of its own. `kVisualOdometry` is the track unprocessed:
/// nothing where it is lost, each segment in its own unit. `warnings` include slow motion and time lapses
/// (`impossible_cadence_hz`), as tracked points show them, or else the thumbnails (`thumbnail_motion`).
///
/// Throws `std::invalid_argument` for `kNone`, or a walk that was not read with what the source needs;
/// `vo::Error` naming a walk that shows no motion to learn from, for `kSad`. With `kSteps`, a walk without
/// steps has displacements of 0 with source `kNone`.
WalkMotion walk_motion(const Walk& walk, MotionSource source, const WalkMotionOptions& options = {});

/// The motion of a walker whose steps are wanted: by `source`, `kHybrid` or `kSteps`, else
/// `std::invalid_argument`. `pedestrian` is always set. Throws as `walk_motion` does, and as
/// `pedestrian_motion` where steps cannot be seen.
WalkMotion motion_with_steps(const Walk& walk, MotionSource source, const WalkMotionOptions& options = {});

/// The values alone, for the sampler.
std::vector<double> displacements(const WalkMotion& motion);

}  // namespace vo
