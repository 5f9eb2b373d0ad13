#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/sequence_search.hpp"
#include "place/match/walk_gaps.hpp"

#include <functional>
#include <vector>

namespace place {

/// Searches each stretch of the query over each stretch of the reference separately, so that no sequence
/// crosses a gap, and joins the results: the reference stretch with the cheapest match counts, and the
/// others' best matches compete with it if they lie outside its uniqueness window. Without gaps, calls
/// `search` directly.
std::vector<SequenceMatch> search_by_stretches(
    const CostMatrix& enhanced, const SequenceSearchOptions& options, const WalkGaps& gaps,
    const std::function<std::vector<SequenceMatch>(const CostMatrix&)>& search);

}  // namespace place
