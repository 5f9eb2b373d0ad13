#include "place/certainty/decoy_search.hpp"

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

}  // namespace

std::vector<double> decoy_scores(const CostMatrix& enhanced, const SearchMethod& method,
                                 const SearchOptions& options) {
  CostMatrix backwards = make_cost_matrix(enhanced.queries, enhanced.references);
  for (std::size_t q = 0; q < enhanced.queries; ++q)
    std::ranges::copy(enhanced.row(enhanced.queries - 1 - q), backwards.row(q).begin());
  std::vector<double> scores;
  for (const SequenceMatch& match : method.search(backwards, reversed(options, enhanced.queries)).matches) {
    if (match.reference) scores.push_back(match.score);
  }
  return scores;
}

}  // namespace place
