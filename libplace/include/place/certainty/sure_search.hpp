#pragma once

#include "place/certainty/match_probability.hpp"
#include "place/match/search_method.hpp"

#include <optional>
#include <vector>

namespace place {

/// A match, how sure it is, and how exact.
struct SureMatch {
  SequenceMatch match;
  /// That the query is at the matched place, rather than at another one of the route or off it; none without
  /// a match, or where there was too little to learn it from.
  std::optional<double> probability;
  std::optional<double> sd_keyframes;  ///< see `place_spread`; none without a match
};

/// Where the probabilities of a walk come from.
enum class ProbabilitySource {
  kDecoys,  ///< calibrated by the walk played backwards, and no surer than the search's own
  kSearch,  ///< the search's own, of a walk too short for that
  kNone,    ///< the walk is too short, and the search has none of its own
};

/// Matches of a walk, with what is known of them.
struct SureMatches {
  std::vector<SureMatch> matches;  ///< one for each query, in order
  ProbabilitySource source = ProbabilitySource::kNone;
  double wrong_share = 1;  ///< estimated share of wrong matches among all; 1 unless the source is decoys
  double looked_at = 1;    ///< share of the matrix's cells that the search looked at
};

/// A search with its certainty: matches (`method`), their probabilities from what the walk played backwards
/// scores (`decoy_scores`, `match_probabilities`), and their spread along the reference (`place_spread`).
///
/// A search whose scores are themselves log odds (`SearchMethod::scores_are_log_odds`) has the last word
/// where it is less sure: a walk that was never on the route also looks more like it forwards than backwards,
/// as things grow with every step, so that decoys alone take it for found; the search sees that being off the
/// route explains it as well.
///
/// A walk of fewer than kFewestScores matches, or whose reverse has as few, has no probabilities but those
/// that the search's scores are themselves (`SearchMethod::scores_are_log_odds`). Cost: the search, twice.
SureMatches search_surely(const CostMatrix& enhanced, const SearchMethod& method,
                          const SearchOptions& options);

}  // namespace place
