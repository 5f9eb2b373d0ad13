#pragma once

#include "place/match/contrast_enhancement.hpp"
#include "place/match/sequence_search.hpp"
#include "place/trajectory/drift_correction.hpp"

#include <span>
#include <vector>

#include <vo/image/image_stack.hpp>
#include <vo/image/patch_normalisation.hpp>

namespace place {

/// Settings of `find_loops`.
struct LoopClosureOptions {
  vo::PatchNormalisationOptions patch;
  ContrastEnhancementOptions enhancement;
  SequenceSearchOptions search;
  double recent_m = 20;    ///< places passed less than this far back are not loops
  double least_score = 1;  ///< of a match, in deviations of the enhanced cost; most of a walk closes no loop
  double least_share = 0.6;  ///< of the matches within a sequence's length that continue along the same line
};

/// Finds where a walk returns to a place it passed before: its keyframes are searched for among those more
/// than `recent_m` earlier, as a query is on a route. A single match is not trusted: its neighbours must
/// follow the earlier part in the same direction.
///
/// `thumbnails`: of the keyframes, grey; `travelled_m`: for each keyframe, not decreasing. The result is by
/// increasing node; empty for a walk shorter than `recent_m` and a sequence. Throws `std::invalid_argument`
/// for another number of thumbnails than of distances, or options that are not valid. O(keyframes^2 * (pixels
/// + lines * length)).
std::vector<LoopClosure> find_loops(const vo::ImageStack& thumbnails, std::span<const double> travelled_m,
                                    const LoopClosureOptions& options = {});

}  // namespace place
