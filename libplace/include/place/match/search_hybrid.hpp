#pragma once

#include "place/match/cost_matrix.hpp"
#include "place/match/search_lines.hpp"
#include "place/match/sequence_search.hpp"

#include <vector>

namespace place {

/// The hybrid search of OpenSeqSLAM2.0 (Talbot, Garg, Milford 2018): between `lines` and `cone`, the cost of
/// a pair is the sum, over the queries of its sequence, of the least cost within the cone between the slowest
/// and the fastest line through it. Like lines, it weighs how alike pictures are; like a cone, it lets the
/// speed change within a sequence; the matches it sums need not be in order.
///
/// The sum is divided by sqrt(terms * length), as in `search_sequences`; options, ends of walks and score are
/// the same as there. Throws `std::invalid_argument` for options that are not valid. O(queries * references *
/// (length + log of the cone's widths)), in parallel over blocks of queries; a block's costs take up to 1 MB
/// per thread, or 32 bytes for each reference if that is more.
std::vector<SequenceMatch> search_hybrid(const CostView& enhanced, const SequenceSearchOptions& options = {});

}  // namespace place
