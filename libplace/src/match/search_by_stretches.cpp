#include "match/search_by_stretches.hpp"

#include <algorithm>

namespace place {
namespace {

CostMatrix part_of(const CostView& whole, Stretch queries, Stretch references) {
  CostMatrix part = make_cost_matrix(queries.end - queries.begin, references.end - references.begin);
  for (std::size_t q = 0; q < part.queries; ++q)
    std::ranges::copy(whole.row(queries.begin + q).subspan(references.begin, part.references),
                      part.row(q).begin());
  return part;
}

}  // namespace

SequenceMatch join_stretches(const SequenceMatch& a, const SequenceMatch& b, std::size_t window) {
  if (!a.reference) return b;
  if (!b.reference) return a;
  const SequenceMatch& best = b.cost < a.cost ? b : a;
  const SequenceMatch& other = b.cost < a.cost ? a : b;
  SequenceMatch joined = best;
  const std::size_t apart = std::max(*a.reference, *b.reference) - std::min(*a.reference, *b.reference);
  // Within the window, what the other was held against still competes.
  const float elsewhere = apart > window ? other.cost : other.cost + other.score;
  joined.score = std::min(best.score, elsewhere - best.cost);
  return joined;
}

std::vector<SequenceMatch> search_by_stretches(
    const CostView& enhanced, const SequenceSearchOptions& options, const WalkGaps& gaps,
    const std::function<std::vector<SequenceMatch>(const CostView&)>& search) {
  const std::vector<Stretch> queries = stretches_between(gaps.query, enhanced.queries);
  const std::vector<Stretch> references = stretches_between(gaps.reference, enhanced.references);
  if (queries.size() <= 1 && references.size() <= 1) return search(enhanced);
  std::vector<SequenceMatch> matches(enhanced.queries);
  const auto window = static_cast<std::size_t>(options.uniqueness_window);
  for (const Stretch& of_query : queries) {
    for (const Stretch& of_reference : references) {
      const std::vector<SequenceMatch> found = search(part_of(enhanced, of_query, of_reference));
      for (std::size_t q = 0; q < found.size(); ++q) {
        SequenceMatch match = found[q];
        if (match.reference) *match.reference += of_reference.begin;
        SequenceMatch& joined = matches[of_query.begin + q];
        joined = join_stretches(joined, match, window);
      }
    }
  }
  return matches;
}

}  // namespace place
