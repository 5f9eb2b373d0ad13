#pragma once

#include "place/trajectory/drift_correction.hpp"
#include "place/trajectory/loop_closure.hpp"

#include <cstddef>

#include <vo/motion/walk_motion.hpp>

namespace place {

/// A walk's trajectory with its loops closed.
struct ClosedLoops {
  std::size_t loops = 0;      ///< keyframes recognised as passed before
  std::size_t believed = 0;   ///< of them, those that the rest of the walk bears out
  vo::Trajectory trajectory;  ///< at each frame; the odometry's own without loops
};

/// Finds where a walk comes back to its own past (PVO 6) and corrects its drift by that, at keyframes half a
/// metre apart: `find_loops`, `correct_drift`. `motion`: of the walk, in metres, with a trajectory, else
/// `std::invalid_argument`. O(keyframes^2).
ClosedLoops close_loops(const vo::Walk& walk, const vo::WalkMotion& motion,
                        const LoopClosureOptions& options);

}  // namespace place
