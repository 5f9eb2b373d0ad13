#pragma once

#include "place/match/search_method.hpp"

#include <vector>

namespace place {

/// Scores of matches that are certainly wrong, for nothing: the query is searched in the reverse order of its
/// keyframes. It shows the same pictures in the same light, next to each other as they were, but no sequence
/// of it goes along the route, so its best matches show how good wrong ones look here. (A stretch that is
/// walked back and forth is found in reverse too; there wrong matches are thought better than they are.)
///
/// `enhanced`, `options` as for the search itself; gaps and steps are turned round with the walk. Returns the
/// scores of the queries that were matched. Cost: that of the search, and 4 bytes a pair.
std::vector<double> decoy_scores(const CostMatrix& enhanced, const SearchMethod& method,
                                 const SearchOptions& options);

}  // namespace place
