#pragma once

#include <cstddef>

#include <place/trajectory/drift_correction.hpp>
#include <place/trajectory/loop_closure.hpp>
#include <vo/motion/walk_motion.hpp>

namespace retrace {

/// A walk's trajectory with its loops closed.
struct ClosedLoops {
  std::size_t loops = 0;      ///< keyframes recognised as passed before
  std::size_t believed = 0;   ///< of them, those that the rest of the walk bears out
  vo::Trajectory trajectory;  ///< at each frame; the odometry's own without loops
};

/// `motion`: with a trajectory. Finds where the walk comes back to its own past (PVO 6) and corrects its
/// drift by that, at keyframes half a metre apart.
ClosedLoops close_loops(const vo::Walk& walk, const vo::WalkMotion& motion,
                        const place::LoopClosureOptions& options);

}  // namespace retrace
