#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/sequence_search.hpp"

#include <optional>
#include <span>
#include <vector>

namespace place {

/// How exactly matches say where the query is, on the right stretch: standard deviations in reference
/// keyframes, none for a query without a match.
///
/// The costs of the five queries about a match, along a line of its slope, are summed as the line is moved
/// along the reference by up to `window` keyframes to either side; each place is as probable as exp(-sum / 2)
/// (the likelihood of `search_path`; neighbouring pictures err together, so that no more than five say
/// anything new). The result is the deviation of these places about their mean, and half a keyframe for what
/// lies between keyframes. A sharp dip of the costs gives 0.5, a flat valley its width; where nothing dips at
/// all, window / sqrt(3).
///
/// `matches`: of a search over `enhanced`, one for each query; throws `std::invalid_argument` if they are
/// not. O(matches * window).
std::vector<std::optional<double>> place_spread(const CostMatrix& enhanced,
                                                std::span<const SequenceMatch> matches, int window = 10);

}  // namespace place
