#include "place/certainty/sure_search.hpp"

#include "place/certainty/decoy_search.hpp"
#include "place/certainty/place_spread.hpp"

#include <algorithm>
#include <cmath>

namespace place {
namespace {

double probability_of(double log_odds) {
  return 1 / (1 + std::exp(-log_odds));
}

}  // namespace

SureMatches search_surely(const CostMatrix& enhanced, const SearchMethod& method,
                          const SearchOptions& options) {
  SearchResult found = method.search(enhanced, options);
  SureMatches result;
  result.looked_at = found.looked_at;
  const auto spread = place_spread(enhanced, found.matches, options.sequence.uniqueness_window);
  std::vector<double> scores;
  for (std::size_t q = 0; q < found.matches.size(); ++q) {
    if (found.matches[q].reference) scores.push_back(static_cast<double>(found.matches[q].score));
    result.matches.push_back({.match = found.matches[q], .probability = {}, .sd_keyframes = spread[q]});
  }
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
      for (std::size_t i = 0; i < scores.size(); ++i)
        probabilities.probability[i] = std::min(probabilities.probability[i], probability_of(scores[i]));
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
