#include "place/certainty/sure_search.hpp"

#include "place/certainty/decoy_search.hpp"
#include "place/certainty/place_spread.hpp"
#include "place/match/search_path.hpp"

#include <algorithm>
#include <cmath>

namespace place {
namespace {

double probability_of(double log_odds) {
  return 1 / (1 + std::exp(-log_odds));
}

std::vector<double> scores_of(std::span<const SequenceMatch> matches) {
  std::vector<double> scores;
  for (const SequenceMatch& match : matches) {
    if (match.reference) scores.push_back(static_cast<double>(match.score));
  }
  return scores;
}

/// Of scores that are log odds: at most the odds.
void limit_by_odds(std::vector<double>& probability, std::span<const double> log_odds) {
  for (std::size_t i = 0; i < probability.size(); ++i)
    probability[i] = std::min(probability[i], probability_of(log_odds[i]));
}

/// Raises the probability of places that are probable on one path through the whole walk, as most are whose
/// neighbours were matched beside them, however alike another place is.
void raise_by_path(std::vector<double>& probability, const CostMatrix& enhanced,
                   std::span<const SequenceMatch> matches, const SearchOptions& options) {
  const SearchMethod& path = search_method("path");
  const std::vector<double> log_odds = scores_of(path_scores(enhanced, matches, options));
  MatchProbabilities by_path = match_probabilities(log_odds, decoy_scores(enhanced, path, options),
                                                   {.decoy_quantile = path.decoy_quantile});
  if (by_path.status != ProbabilityStatus::kGiven) return;
  limit_by_odds(by_path.probability, log_odds);
  for (std::size_t i = 0; i < probability.size(); ++i)
    probability[i] = std::max(probability[i], by_path.probability[i]);
}

}  // namespace

SureMatches search_surely(const CostMatrix& enhanced, const SearchMethod& method,
                          const SearchOptions& options) {
  SearchResult found = method.search(enhanced, options);
  SureMatches result;
  result.looked_at = found.looked_at;
  const auto spread = place_spread(enhanced, found.matches, options.sequence.uniqueness_window);
  const std::vector<double> scores = scores_of(found.matches);
  for (std::size_t q = 0; q < found.matches.size(); ++q)
    result.matches.push_back({.match = found.matches[q], .probability = {}, .sd_keyframes = spread[q]});
  if (scores.empty()) return result;

  MatchProbabilities probabilities;
  if (scores.size() >= kFewestScores) {
    probabilities = match_probabilities(scores, decoy_scores(enhanced, method, options),
                                        {.decoy_quantile = method.decoy_quantile});
  } else {
    probabilities.status = ProbabilityStatus::kFewMatches;
  }
  if (probabilities.status == ProbabilityStatus::kGiven) {
    result.source = ProbabilitySource::kDecoys;
    result.wrong_share = probabilities.wrong_share;
    if (method.scores_are_log_odds) {
      limit_by_odds(probabilities.probability, scores);
    } else {
      raise_by_path(probabilities.probability, enhanced, found.matches, options);
    }
  } else if (method.scores_are_log_odds) {
    result.source = ProbabilitySource::kSearch;
    for (const double score : scores) probabilities.probability.push_back(probability_of(score));
  } else {
    return result;
  }
  auto next = probabilities.probability.begin();
  for (SureMatch& match : result.matches) {
    if (match.match.reference) match.probability = *next++;
  }
  return result;
}

}  // namespace place
