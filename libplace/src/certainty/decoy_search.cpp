#include "place/certainty/decoy_search.hpp"

#include "certainty/part_certainty.hpp"

#include <algorithm>

namespace place {
namespace {

SearchOptions reversed(SearchOptions options, std::size_t queries) {
  std::vector<std::size_t> gaps;
  for (const std::size_t gap : options.gaps.query) {
    if (gap > 0 && gap < queries) gaps.push_back(queries - gap);
  }
  std::ranges::reverse(gaps);
  options.gaps.query = std::move(gaps);
  // The step to a keyframe becomes the step from it; the first, which is unused, stays.
  std::vector<double>& steps = options.path.steps;
  if (!steps.empty()) std::ranges::reverse(steps.begin() + 1, steps.end());
  return options;
}

CostMatrix backwards_of(const CostView& enhanced) {
  CostMatrix backwards = make_cost_matrix(enhanced.queries, enhanced.references);
  for (std::size_t q = 0; q < enhanced.queries; ++q)
    std::ranges::copy(enhanced.row(enhanced.queries - 1 - q), backwards.row(q).begin());
  return backwards;
}

std::vector<double> scores_of(const std::vector<SequenceMatch>& matches) {
  std::vector<double> scores;
  for (const SequenceMatch& match : matches)
    if (match.reference) scores.push_back(match.score);
  return scores;
}

}  // namespace

std::vector<double> decoy_scores(const CostView& enhanced, const SearchMethod& method,
                                 const SearchOptions& options) {
  return scores_of(method.search(backwards_of(enhanced), reversed(options, enhanced.queries)).matches);
}

std::vector<double> decoy_scores_part(const MatrixPart& enhanced, const SearchMethod& method,
                                      const SearchOptions& options, Team& team) {
  const CostMatrix backwards = backwards_of(enhanced.costs);
  MatrixPart part = enhanced;
  part.costs = backwards;
  return scores_of(method.search_part(part, reversed(options, enhanced.queries()), team).matches);
}

}  // namespace place
