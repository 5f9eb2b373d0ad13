#pragma once

#include "place/certainty/match_probability.hpp"
#include "place/match/search_method.hpp"

#include <optional>
#include <vector>

namespace place {

/// A match, its probability and its precision.
struct SureMatch {
  SequenceMatch match;
  /// Probability that the query is at the matched place, rather than elsewhere on the route or off it; none
  /// without a match, or with too little to learn it from.
  std::optional<double> probability;
  std::optional<double> sd_keyframes;  ///< see `place_spread`; none without a match
};

/// Where the probabilities of a walk come from.
enum class ProbabilitySource {
  kDecoys,  ///< calibrated by the reversed walk, and at most the search's own
  kSearch,  ///< the search's own, for a walk too short for decoys
  kNone,    ///< the walk is too short, and the search gives none
};

/// Matches of a walk and their certainty.
struct SureMatches {
  std::vector<SureMatch> matches;  ///< one for each query, in order
  ProbabilitySource source = ProbabilitySource::kNone;
  double wrong_share = 1;  ///< estimated share of wrong matches among all; 1 unless the source is decoys
  double looked_at = 1;    ///< share of the matrix's cells that the search looked at
};

/// A search with its certainty: matches (`method`), their probabilities from the scores of the reversed walk
/// (`decoy_scores`, `match_probabilities`), and their spread along the reference (`place_spread`).
///
/// If the search's scores are log odds (`SearchMethod::scores_are_log_odds`), the lower of the two
/// probabilities counts. A walk that was never on the route also matches it better forwards than backwards,
/// as things grow with every step, so decoys alone would accept it; the search's own probability allows for
/// being off the route.
///
/// Scores that compare a place with the next best one say little of a walk along which much looks alike: its
/// right matches are hardly more distinct than its wrong ones. But they lie on one path. So a match of any
/// other search has the higher of two probabilities: the one from its score, and the one that the path search
/// gives its place (`path_scores`), calibrated and limited as above.
///
/// A walk with fewer than kFewestScores matches, or whose reverse has fewer, has only the search's own
/// probabilities, if it gives any (`SearchMethod::scores_are_log_odds`). Cost: two searches; for a search
/// other than `path`, two path searches more.
SureMatches search_surely(const CostView& enhanced, const SearchMethod& method, const SearchOptions& options);

}  // namespace place
