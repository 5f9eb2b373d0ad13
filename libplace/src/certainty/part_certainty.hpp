#pragma once

#include "place/certainty/sure_search.hpp"
#include "place/match/matrix_part.hpp"

#include <optional>
#include <span>
#include <vector>

/// The certainty of a search by a team (`SearchMethod::search_part`): every member gets the same.
namespace place {

/// `place_spread`: the member whose shard a match is on works it out. The part must reach `window` and twice
/// the steepest slope beyond the shard. Members meet once.
std::vector<std::optional<double>> place_spread_part(const MatrixPart& enhanced,
                                                     std::span<const SequenceMatch> matches, int window,
                                                     Team& team);

/// `decoy_scores`.
std::vector<double> decoy_scores_part(const MatrixPart& enhanced, const SearchMethod& method,
                                      const SearchOptions& options, Team& team);

/// `search_surely`. Throws `std::invalid_argument` for a method that no team can do.
SureMatches search_surely_part(const MatrixPart& enhanced, const SearchMethod& method,
                               const SearchOptions& options, Team& team);

}  // namespace place
