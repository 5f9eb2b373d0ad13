#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/search_lines.hpp"
#include "place/match/sequence_search.hpp"

#include <vector>

namespace place {

/// The cone search of OpenSeqSLAM2.0 (Talbot, Garg, Milford 2018): a pair's sequence is the whole cone
/// between the slowest and the fastest line through it, and counts the queries whose single best match of all
/// references lies inside. A walker may change speed within a sequence; how alike the pictures are beyond
/// being the best does not matter.
///
/// The cost of a pair is minus its count over sqrt(terms * length), `terms` the queries whose part of the
/// cone touches the reference (see `search_sequences`; a count over the length where the cone is whole). Of
/// equal pairs the one of the lower own cost is taken, where the original takes the first. The score is the
/// difference to the best pair outside the uniqueness window, one without any vote costs 0. Queries without
/// any vote near (a flat row votes for its first reference) stay unmatched.
///
/// Throws `std::invalid_argument` for options that are not valid. O(queries * (references + sum of the cone's
/// widths)), in parallel.
std::vector<SequenceMatch> search_cone(const CostMatrix& enhanced, const SequenceSearchOptions& options = {});

}  // namespace place
