#pragma once

#include "place/match/matrix_part.hpp"
#include "place/match/search_method.hpp"
#include "place/match/team.hpp"

/// Search methods that a team can do: each member has a part of the matrix, and all get the same result, to
/// the bit that of one member with the whole.
namespace place {

/// `search_path`. Members meet up to five times for each query: in both forward passes, in the backward one,
/// and twice for its match.
SearchResult search_path_part(const MatrixPart& enhanced, const SearchOptions& options, Team& team);

/// `path_scores`.
std::vector<SequenceMatch> path_scores_part(const MatrixPart& enhanced,
                                            std::span<const SequenceMatch> matches,
                                            const SearchOptions& options, Team& team);

/// `lines` of `search_methods`. Members meet once, and twice more for each pair of stretches between gaps.
/// The part must reach `reach_of(search_lines(...)) + SequenceSearcher::kPart` references beyond the shard,
/// as far as the reference goes.
SearchResult search_lines_part(const MatrixPart& enhanced, const SearchOptions& options, Team& team);

}  // namespace place
