#pragma once

#include "place/match/search_method.hpp"

#include <vector>

namespace place {

/// Scores of matches that are certainly wrong, without extra data: the query is searched with its keyframes
/// in reverse order. It has the same pictures in the same light, with the same neighbours, but no sequence of
/// it follows the route, so its best matches show how good wrong ones look here. (A stretch walked back and
/// forth is found in reverse too, which makes wrong matches look better than they are.)
///
/// `enhanced`, `options` as for the search itself; gaps and steps are reversed with the walk. Returns the
/// scores of the matched queries. Cost: that of the search, and 4 bytes per pair.
std::vector<double> decoy_scores(const CostView& enhanced, const SearchMethod& method,
                                 const SearchOptions& options);

}  // namespace place
