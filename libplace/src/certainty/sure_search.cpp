#include "place/certainty/sure_search.hpp"

#include "certainty/part_certainty.hpp"
#include "match/part_searches.hpp"
#include "place/certainty/decoy_search.hpp"
#include "place/certainty/place_spread.hpp"
#include "place/match/search_path.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

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

/// What the certainty of matches is learned from, worked out when it is needed.
struct Evidence {
  std::vector<std::optional<double>> spread;
  std::function<std::vector<double>(const SearchMethod&)> decoys;  ///< their scores by a method
  std::function<std::vector<SequenceMatch>()> path_scores;         ///< the matches, scored by the path
};

/// Raises the probability of places that are probable on one path through the whole walk, as most are whose
/// neighbours were matched beside them, however alike another place is.
void raise_by_path(std::vector<double>& probability, const Evidence& evidence) {
  const SearchMethod& path = search_method("path");
  const std::vector<double> log_odds = scores_of(evidence.path_scores());
  MatchProbabilities by_path =
      match_probabilities(log_odds, evidence.decoys(path), {.decoy_quantile = path.decoy_quantile});
  if (by_path.status != ProbabilityStatus::kGiven) return;
  limit_by_odds(by_path.probability, log_odds);
  for (std::size_t i = 0; i < probability.size(); ++i)
    probability[i] = std::max(probability[i], by_path.probability[i]);
}

/// What was found, with its certainty.
SureMatches with_certainty(const SearchResult& found, const SearchMethod& method, const Evidence& evidence) {
  SureMatches result;
  result.looked_at = found.looked_at;
  const std::vector<double> scores = scores_of(found.matches);
  for (std::size_t q = 0; q < found.matches.size(); ++q)
    result.matches.push_back(
        {.match = found.matches[q], .probability = {}, .sd_keyframes = evidence.spread[q]});
  if (scores.empty()) return result;

  MatchProbabilities probabilities;
  if (scores.size() >= kFewestScores) {
    probabilities =
        match_probabilities(scores, evidence.decoys(method), {.decoy_quantile = method.decoy_quantile});
  } else {
    probabilities.status = ProbabilityStatus::kFewMatches;
  }
  if (probabilities.status == ProbabilityStatus::kGiven) {
    result.source = ProbabilitySource::kDecoys;
    result.wrong_share = probabilities.wrong_share;
    if (method.scores_are_log_odds) {
      limit_by_odds(probabilities.probability, scores);
    } else {
      raise_by_path(probabilities.probability, evidence);
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

SureMatches search_surely(const CostView& enhanced, const SearchMethod& method,
                          const SearchOptions& options) {
  const SearchResult found = method.search(enhanced, options);
  return with_certainty(
      found, method,
      {.spread = place_spread(enhanced, found.matches, options.sequence.uniqueness_window),
       .decoys = [&](const SearchMethod& by) { return decoy_scores(enhanced, by, options); },
       .path_scores = [&] { return path_scores(enhanced, found.matches, options); }});
}

SureMatches search_surely_part(const MatrixPart& enhanced, const SearchMethod& method,
                               const SearchOptions& options, Team& team) {
  if (method.search_part == nullptr)
    throw std::invalid_argument("search_surely: a method that a team can do expected");
  const SearchResult found = method.search_part(enhanced, options, team);
  return with_certainty(
      found, method,
      {.spread = place_spread_part(enhanced, found.matches, options.sequence.uniqueness_window, team),
       .decoys = [&](const SearchMethod& by) { return decoy_scores_part(enhanced, by, options, team); },
       .path_scores = [&] { return path_scores_part(enhanced, found.matches, options, team); }});
}

}  // namespace place
