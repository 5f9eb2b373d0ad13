#include "place/match/search_method.hpp"

#include "match/search_by_stretches.hpp"
#include "place/match/search_cone.hpp"
#include "place/match/search_graph.hpp"
#include "place/match/search_hybrid.hpp"
#include "place/match/search_path.hpp"
#include "place/match/sequence_searcher.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

/// A search that does not handle gaps, over the stretches between them.
template <auto kSearch>
SearchResult by_stretches(const CostMatrix& enhanced, const SearchOptions& options) {
  const auto search = [&](const CostMatrix& part) { return kSearch(part, options.sequence); };
  return {.matches = search_by_stretches(enhanced, options.sequence, options.gaps, search)};
}

/// Lines, centred on the mean of all costs in every stretch, so that stretches can be compared.
SearchResult search_straight_lines(const CostMatrix& enhanced, const SearchOptions& options) {
  const CostRange range = range_of(enhanced.values);
  const auto search = [&](const CostMatrix& part) {
    SequenceSearcher searcher(part.queries, part.references, range, options.sequence);
    searcher.push(block_of(part), part.references);
    return searcher.finish();
  };
  SearchResult result{.matches = search_by_stretches(enhanced, options.sequence, options.gaps, search)};
  if (options.sequence.score == MatchScore::kRatio && !enhanced.values.empty()) {
    const float least = *std::ranges::min_element(enhanced.values);
    score_by_ratio(result.matches, least - static_cast<float>(range.centre));
  }
  return result;
}

constexpr std::array kMethods{
    SearchMethod{"lines", "the best straight line through each query (SeqSLAM)", &search_straight_lines},
    SearchMethod{"cone", "most single best matches within a cone of speeds (OpenSeqSLAM2)",
                 &by_stretches<search_cone>},
    SearchMethod{"hybrid", "the best match of each query within a cone of speeds, summed (OpenSeqSLAM2)",
                 &by_stretches<search_hybrid>},
    SearchMethod{"graph", "one cheapest path, looked for lazily, that may skip pictures that match nowhere",
                 &search_graph},
    SearchMethod{"path", "the most probable place at each picture of one path through the whole walk",
                 &search_path, 0.9, true},
};

}  // namespace

std::span<const SearchMethod> search_methods() {
  return kMethods;
}

const SearchMethod& search_method(std::string_view name) {
  std::string names;
  for (const SearchMethod& method : kMethods) {
    if (method.name == name) return method;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  throw vo::Error("search method", fmt::format("'{}' is not known", name), "one of " + names);
}

}  // namespace place
