#pragma once

#include "vo/base/frame_range.hpp"
#include "vo/motion/alignment_error.hpp"

#include <optional>
#include <span>
#include <vector>

namespace vo {

/// Settings of `predict_displacement`.
struct LearnedRelationOptions {
  int separations = 5;   ///< spans compared for each frame's motion, as in MotionModelOptions
  double max_speed = 2;  ///< times the mean speed learned from; what is faster is a turn or a jolt
};

/// Displacement of frames by their alignment error, through the relation that it has to displacements known
/// from elsewhere, "instead of frame separation values" (SSS 3.5). The sum over what it was learned from is
/// kept, so that a bent relation adds no length.
///
/// `time_s`: of each frame of the walk, increasing; `usable`: one flag per frame, false where its error says
/// nothing; `known`: the displacement of each frame, in any unit, none where it is not known. Learns from the
/// frames of `from` that are known and usable, and gives one value for each frame of `target`, usable or not;
/// none where a gap of the clock leaves nothing to compare; empty if there is nothing to be learned. Throws
/// `std::invalid_argument` if the sizes disagree or a range is not of the walk. O(frames from the first of
/// both ranges to the last * separations).
std::vector<std::optional<double>> predict_displacement(const AlignmentErrors& errors,
                                                        std::span<const double> time_s,
                                                        const std::vector<bool>& usable,
                                                        std::span<const std::optional<double>> known,
                                                        FrameRange from, FrameRange target,
                                                        const LearnedRelationOptions& options = {});

}  // namespace vo
