#pragma once

#include "vo/image/image_stack.hpp"

#include <span>
#include <vector>

namespace vo {

/// How unlike views are that have nothing to do with each other: the median error of frames half the walk
/// apart. Two unrelated pictures of independent normal pixels have 2 / sqrt(pi) = 1.13. `normalised`: bytes
/// of `patch_normalise`; 0 for fewer than two. O(frames * pixels), in parallel.
double distant_error(const ImageStack& normalised);

/// True if a walk of this distant error never leaves its first view, or there is nothing to be seen at all:
/// less than a third of the error of unrelated pictures.
bool standing_still(double distant_error);

/// Settings of `standing_steps`.
struct StandingOptions {
  double span_s = 2;  ///< seconds over which a walker's view changes for good, a standing one's not; 0: never
  double alike = 2.0 / 3;  ///< share of the distant error below which two views are of one place
};

/// The steps from one frame to the next at which the walker stands still. One flag per frame, for the step
/// that leads to it; the first is false.
///
/// SSS has no such stage: there, sway and breathing of a standing walker count as motion, a fifth of walking
/// by alignment error alone. But they come back to where they were: a span is standing if its first, middle
/// and last frame are all within `limit` of each other. Three frames, because two places along a fence or a
/// row of doors may look alike by chance. Black frames do not change either, and tell nothing.
///
/// `normalised`: bytes of `patch_normalise`; `time_s`: one per frame, increasing. O(frames * pixels), in
/// parallel.
std::vector<bool> standing_steps(const ImageStack& normalised, std::span<const double> time_s,
                                 double distant_error, const StandingOptions& options = {});

}  // namespace vo
