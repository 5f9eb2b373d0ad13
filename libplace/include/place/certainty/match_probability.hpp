#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// Settings of `match_probabilities`.
struct MatchProbabilityOptions {
  /// The share of wrong matches is estimated from the scores below this quantile of the decoys' scores, where
  /// hardly any right match should be; see `SearchMethod::decoy_quantile`.
  double decoy_quantile = 0.5;
};

/// Why there are no probabilities.
enum class ProbabilityStatus {
  kGiven,
  kFewMatches,  ///< fewer than kFewestScores matches
  kFewDecoys,   ///< fewer than kFewestScores scores of wrong matches
};
inline constexpr std::size_t kFewestScores = 10;

/// The certainty of a walk's matches.
struct MatchProbabilities {
  ProbabilityStatus status = ProbabilityStatus::kGiven;
  std::vector<double> probability;  ///< of each match, in order; empty unless given
  double wrong_share = 1;           ///< estimated share of wrong matches among all
};

/// The probability that each match is right, from scores alone: those of the walk's matches, some of which
/// are wrong, and those of decoys, all of which are wrong (`decoy_scores`). Higher scores must mean surer
/// matches.
///
/// A share w of the matches' scores comes from the decoys' density f0, the rest from that of right matches,
/// f1 = f0 exp(a + b score): the exponential tilt of Efron and Tibshirani 1996, which makes the probability
/// (1 - w) f1 / (w f0 + (1 - w) f1) a logistic curve in the score: monotone, never 0 or 1, and stable on
/// short walks with only two parameters. It is one minus the local false discovery rate (Efron 2008). w is
/// Storey's estimate (2002): the share of the matches below a quantile of the decoys over that quantile, as
/// if one more wrong match had been seen. a and b are found by expectation maximisation: each match counts as
/// right by its probability, and a logistic regression separates these from the rest and the decoys.
///
/// "Right" means not a false place: near misses (a few keyframes off on the right stretch) have no decoys;
/// `place_spread` gives the precision of a match. Throws `std::invalid_argument` for a score that is not a
/// number or a quantile outside 0 < quantile <= 1. O(matches + decoys) for each of up to 200 rounds.
MatchProbabilities match_probabilities(std::span<const double> scores, std::span<const double> decoys,
                                       const MatchProbabilityOptions& options = {});

}  // namespace place
