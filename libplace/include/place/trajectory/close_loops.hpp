#pragma once

#include "place/trajectory/drift_correction.hpp"
#include "place/trajectory/loop_closure.hpp"

#include <cstddef>

#include <vo/motion/walk_motion.hpp>

namespace place {

/// A walk's trajectory with its loops closed.
struct ClosedLoops {
  std::size_t loops = 0;      ///< keyframes recognised as passed before
  std::size_t believed = 0;   ///< those of them that the rest of the walk confirms
  vo::Trajectory trajectory;  ///< at each frame; the odometry's own without loops
};

/// Finds where a walk returns to places it has passed (PVO 6) and corrects its drift from that, at keyframes
/// half a metre apart: `find_loops`, `correct_drift`. Over a long gap of the recording (`vo::parts_walk`) the
/// odometry counts for nothing. `motion`: of the walk, in metres, with a trajectory,
/// else throws `std::invalid_argument`. O(keyframes^2).
ClosedLoops close_loops(const vo::Walk& walk, const vo::WalkMotion& motion,
                        const LoopClosureOptions& options);

}  // namespace place
