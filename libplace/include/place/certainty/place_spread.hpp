#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/sequence_search.hpp"

#include <optional>
#include <span>
#include <vector>

namespace place {

/// The precision of matches along the right stretch: standard deviations in reference keyframes, none for a
/// query without a match.
///
/// The costs of the five queries around a match, along a line of its slope, are summed as the line is shifted
/// along the reference by up to `window` keyframes to either side; each place has a probability proportional
/// to exp(-sum / 2) (the likelihood of `search_path`; neighbouring pictures have similar errors, so more than
/// five add nothing). The result combines the deviation of these places from their mean with half a keyframe
/// for places between keyframes. A sharp dip in the costs gives 0.5, a flat valley its width, and no dip at
/// all sqrt(window (window + 1) / 3 + 1 / 4).
///
/// `matches`: of a search over `enhanced`, one for each query; otherwise throws `std::invalid_argument`.
/// O(matches * window).
std::vector<std::optional<double>> place_spread(const CostView& enhanced,
                                                std::span<const SequenceMatch> matches, int window = 10);

}  // namespace place
