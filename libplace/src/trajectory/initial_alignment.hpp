#pragma once

#include "place/trajectory/drift_correction.hpp"
#include "trajectory/pose_graph.hpp"

#include <span>
#include <vector>

namespace place {

/// The starting point of a pose graph: the odometry placed on the map piece by piece, so that heading may
/// have drifted by any amount.
///
/// Each fix is a whole pose and so places the odometry around it on the map; its neighbours within some
/// metres of path agree with that or not. The fixes with most agreement are anchors (pairwise consistency as
/// in Mangelson et al., "Pairwise Consistent Measurement Set Maximization for Robust Multi-robot Map
/// Merging", 2018, on a chain). Between them, the rotation from odometry to map changes evenly from one
/// anchor's to the next's; the path is dead reckoned with it and joined to the anchors.
///
/// `travelled_m`: for each node, along the odometry. None if no three fixes agree. O(fixes), each with at
/// most 64 others.
std::vector<pose_graph::State> initial_alignment(const vo::Trajectory& odometry,
                                                 std::span<const double> travelled_m,
                                                 std::span<const PoseFix> fixes);

/// The odometry unchanged, with headings unwrapped.
std::vector<pose_graph::State> unaligned(const vo::Trajectory& odometry);

}  // namespace place
