#include "place/match/sequence_search.hpp"

#include "place/match/sequence_searcher.hpp"

namespace place {

std::vector<SequenceMatch> search_sequences(const CostView& enhanced, const SequenceSearchOptions& options) {
  // Enhanced costs are centred at 0 up to rounding; costs that are not enhanced are centred here.
  SequenceSearcher searcher(enhanced.queries, enhanced.references, range_of(enhanced.values), options);
  searcher.push(block_of(enhanced), enhanced.references);
  return searcher.finish();
}

void score_by_ratio(std::vector<SequenceMatch>& matches, float least) {
  for (SequenceMatch& match : matches) {
    if (!match.reference) continue;
    const float elsewhere = match.cost + match.score - least;
    match.score = elsewhere > 0 ? match.score / elsewhere : 0;
  }
}

}  // namespace place
