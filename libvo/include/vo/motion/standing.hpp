#pragma once

#include "vo/image/image_stack.hpp"

#include <span>
#include <vector>

namespace vo {

/// How unlike views are that have nothing to do with each other: the median error of frames half the walk
/// apart. Two unrelated pictures of independent normal pixels have 2 / sqrt(pi) = 1.13. `normalised`: bytes
/// of `patch_normalise`; `excluded`: one flag per frame that is left out, or empty; 0 for fewer than two
/// frames left. O(frames * pixels), in parallel.
double distant_error(const ImageStack& normalised, const std::vector<bool>& excluded = {});

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

/// Where a walker stands, and what that is told by.
struct Stands {
  std::vector<bool> standing;  ///< as `standing_steps`; empty if the walk never leaves its first view
  double distant_error = 0;    ///< that they were told by
  bool still = false;          ///< the walk never leaves its first view, or shows nothing
};

/// The same for a walk of which nothing is known yet. In one that stands most of the time, frames half the
/// walk apart are mostly of one place and say nothing of how unlike places are; there the frames between the
/// stands say it, and whether the walk leaves its first view the most unlike tenth. Throws and costs as
/// `standing_steps`.
Stands find_stands(const ImageStack& normalised, std::span<const double> time_s,
                   const StandingOptions& options = {});

}  // namespace vo
