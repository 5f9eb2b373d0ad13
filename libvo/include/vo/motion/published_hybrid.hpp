#pragma once

#include "vo/motion/hybrid_motion.hpp"
#include "vo/motion/motion_evidence.hpp"

#include <vector>

namespace vo {

/// Visual odometry where it works, alignment error where it is lost, as SSS 3.5 has them and no more:
///
/// - The relation of alignment error and displacement is learned from the segment that was just lost, "for as
///   long as the visual odometry system works" (SSS 1), so from the past only, and from neighbouring frames
///   it gives the displacement (Eq. 3), until visual odometry begins anew. A segment too short to learn from
///   leaves the relation of the one before; before there is any, a lost frame has no displacement.
/// - Each segment keeps the unit it came in, so that its beginning may be a jump of scale (5.2, Fig. 9).
///
/// No steps, no ground, no smoothing, no tie of scales: `hybrid_motion` is ours, which has them. The visual
/// odometry itself is ours as well, where SSS has ORB-SLAM; a trajectory of ORB-SLAM's may be read from a
/// file.
///
/// `evidence`: with a track; of the rest, alignment errors count. One displacement for each frame, in the
/// unit of its segment. Throws `std::invalid_argument` for evidence without a track, or if sizes disagree.
/// O(losses * frames * spans * log frames).
std::vector<FrameDisplacement> hybrid_as_published(const MotionEvidence& evidence);

}  // namespace vo
