#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/sequence_search.hpp"
#include "place/match/walk_gaps.hpp"

#include <cstddef>
#include <functional>
#include <vector>

namespace place {

/// Searches each stretch of the query over each stretch of the reference separately, so that no sequence
/// crosses a gap, and joins the results: the reference stretch with the cheapest match counts, and the
/// others' best matches compete with it if they lie outside its uniqueness window, otherwise what those were
/// held against. Without gaps, calls `search` directly.
std::vector<SequenceMatch> search_by_stretches(
    const CostView& enhanced, const SequenceSearchOptions& options, const WalkGaps& gaps,
    const std::function<std::vector<SequenceMatch>(const CostView&)>& search);

/// Joins the matches of two stretches of the reference for a query. A match's score is the difference to the
/// cost elsewhere; `window`: `SequenceSearchOptions::uniqueness_window`.
SequenceMatch join_stretches(const SequenceMatch& a, const SequenceMatch& b, std::size_t window);

}  // namespace place
