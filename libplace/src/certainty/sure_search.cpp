#include "place/certainty/sure_search.hpp"

#include "certainty/part_certainty.hpp"
#include "place/certainty/decoy_search.hpp"
#include "place/certainty/place_spread.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace place {
namespace {

double probability_of(double log_odds) {
  return 1 / (1 + std::exp(-log_odds));
}

/// What was found, with its certainty. `decoys`: their scores, when they are needed.
SureMatches with_certainty(const SearchResult& found, const std::vector<std::optional<double>>& spread,
                           const SearchMethod& method, const std::function<std::vector<double>()>& decoys) {
  SureMatches result;
  result.looked_at = found.looked_at;
  std::vector<double> scores;
  for (std::size_t q = 0; q < found.matches.size(); ++q) {
    if (found.matches[q].reference) scores.push_back(static_cast<double>(found.matches[q].score));
    result.matches.push_back({.match = found.matches[q], .probability = {}, .sd_keyframes = spread[q]});
  }
  if (scores.empty()) return result;

  MatchProbabilities probabilities;
  if (scores.size() >= kFewestScores) {
    probabilities = match_probabilities(scores, decoys(), {.decoy_quantile = method.decoy_quantile});
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

}  // namespace

SureMatches search_surely(const CostMatrix& enhanced, const SearchMethod& method,
                          const SearchOptions& options) {
  const SearchResult found = method.search(enhanced, options);
  return with_certainty(found, place_spread(enhanced, found.matches, options.sequence.uniqueness_window),
                        method, [&] { return decoy_scores(enhanced, method, options); });
}

SureMatches search_surely_part(const MatrixPart& enhanced, const SearchMethod& method,
                               const SearchOptions& options, Team& team) {
  if (method.search_part == nullptr)
    throw std::invalid_argument("search_surely: a method that a team can do expected");
  const SearchResult found = method.search_part(enhanced, options, team);
  return with_certainty(found,
                        place_spread_part(enhanced, found.matches, options.sequence.uniqueness_window, team),
                        method, [&] { return decoy_scores_part(enhanced, method, options, team); });
}

}  // namespace place
