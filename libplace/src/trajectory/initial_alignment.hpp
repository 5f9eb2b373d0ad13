#pragma once

#include "place/trajectory/drift_correction.hpp"
#include "trajectory/pose_graph.hpp"

#include <span>
#include <vector>

namespace place {

/// Where a pose graph starts from: the odometry laid on the map piece by piece, so that heading may have
/// drifted by any amount on the way.
///
/// Each fix, being a whole pose, says how the odometry lies on the map around it; its neighbours within some
/// metres of the way agree with that or not. Those that most neighbours agree with are anchors (pairwise
/// consistency as in Mangelson et al., "Pairwise Consistent Measurement Set Maximization for Robust
/// Multi-robot Map Merging", 2018, on a chain). Between them, the turn from odometry to map goes evenly from
/// one anchor's to the next's; the way is dead reckoned with it and joined to the anchors.
///
/// `travelled_m`: by node, along the odometry. None if no three fixes agree. O(fixes), each with at most 64
/// others.
std::vector<pose_graph::State> initial_alignment(const vo::Trajectory& odometry,
                                                 std::span<const double> travelled_m,
                                                 std::span<const PoseFix> fixes);

/// The odometry as it is, headings unwrapped.
std::vector<pose_graph::State> unaligned(const vo::Trajectory& odometry);

}  // namespace place
