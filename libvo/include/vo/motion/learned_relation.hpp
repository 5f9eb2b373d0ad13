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
  double max_speed = 2;  ///< times the mean speed learned from; anything faster is a turn or a jolt
};

/// Displacement of frames from their alignment error, by its relation to displacements known from elsewhere,
/// "instead of frame separation values" (SSS 3.5). The sum over the frames learned from is preserved, so that
/// a curved relation adds no length.
///
/// `time_s`: of each frame of the walk, increasing; `usable`: one flag per frame, false where its error shows
/// nothing; `known`: the displacement of each frame, in any unit, none where it is not known. Learns from the
/// frames of `from` that are known and usable, and gives one value for each frame of `target`, usable or not;
/// none where a gap of the clock leaves nothing to compare; empty if there is nothing to learn from. Throws
/// `std::invalid_argument` if the sizes disagree or a range is not within the walk. O(frames spanned by both
/// ranges * separations).
std::vector<std::optional<double>> predict_displacement(const AlignmentErrors& errors,
                                                        std::span<const double> time_s,
                                                        const std::vector<bool>& usable,
                                                        std::span<const std::optional<double>> known,
                                                        FrameRange from, FrameRange target,
                                                        const LearnedRelationOptions& options = {});

}  // namespace vo
