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
  double recent_m = 20;    ///< what was passed within so many metres of the way is no loop
  double least_score = 1;  ///< of a match, in deviations of the enhanced cost; most of a walk closes no loop
  double least_share = 0.6;  ///< of the matches of a sequence's length that go on along the same line
};

/// Where a walk comes back to what it passed before: the walk's keyframes searched for among those that are
/// more than `recent_m` of the way back, as a query is on a route. A match alone is not believed: its
/// neighbours must go along the earlier part as it does.
///
/// `thumbnails`: of the keyframes, grey; `travelled_m`: by keyframe, not decreasing. By increasing node; none
/// for a walk shorter than `recent_m` and a sequence. Throws `std::invalid_argument` for another number of
/// thumbnails than of distances, or options that are not valid. O(keyframes^2 * (pixels + lines * length)).
std::vector<LoopClosure> find_loops(const vo::ImageStack& thumbnails, std::span<const double> travelled_m,
                                    const LoopClosureOptions& options = {});

}  // namespace place
