#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/search_lines.hpp"
#include "place/match/sequence_search.hpp"

#include <vector>

namespace place {

/// The cone search of OpenSeqSLAM2.0 (Talbot, Garg, Milford 2018): a pair's sequence is the whole cone
/// between the slowest and the fastest line through it, and counts the queries whose single best match among
/// all references lies inside. A walker may change speed within a sequence; only which reference is best
/// matters, not how alike the pictures are.
///
/// The cost of a pair is minus its count over sqrt(terms * length), `terms` the queries whose part of the
/// cone touches the reference (see `search_sequences`; a count over the length where the cone is whole).
/// Among equal pairs the one with the lower own cost is taken; the original takes the first. The score is the
/// difference to the best pair outside the uniqueness window; a pair without votes costs 0. Queries without
/// any vote nearby (a flat row votes for its first reference) stay unmatched.
///
/// Throws `std::invalid_argument` for options that are not valid. O(queries * (references + length * sum of
/// the cone's widths)), in parallel.
std::vector<SequenceMatch> search_cone(const CostView& enhanced, const SequenceSearchOptions& options = {});

}  // namespace place
