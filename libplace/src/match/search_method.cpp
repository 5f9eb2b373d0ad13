#include "place/match/search_method.hpp"

#include "match/part_searches.hpp"
#include "match/search_by_stretches.hpp"
#include "place/match/search_cone.hpp"
#include "place/match/search_graph.hpp"
#include "place/match/search_hybrid.hpp"
#include "place/match/search_path.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include <vo/base/error.hpp>

namespace place {
namespace {

/// A search that does not handle gaps, over the stretches between them.
template <auto kSearch>
SearchResult by_stretches(const CostView& enhanced, const SearchOptions& options) {
  const auto search = [&](const CostView& part) { return kSearch(part, options.sequence); };
  return {.matches = search_by_stretches(enhanced, options.sequence, options.gaps, search)};
}

SearchResult search_straight_lines(const CostView& enhanced, const SearchOptions& options) {
  Alone alone;
  return search_lines_part(whole_of(enhanced), options, alone);
}

constexpr std::array kMethods{
    SearchMethod{"lines", "the best straight line through each query (SeqSLAM)", &search_straight_lines, 0.5,
                 false, &search_lines_part},
    SearchMethod{"cone", "most single best matches within a cone of speeds (OpenSeqSLAM2)",
                 &by_stretches<search_cone>},
    SearchMethod{"hybrid", "the best match of each query within a cone of speeds, summed (OpenSeqSLAM2)",
                 &by_stretches<search_hybrid>},
    SearchMethod{"graph", "one cheapest path, looked for lazily, that may skip pictures that match nowhere",
                 &search_graph},
    SearchMethod{"path", "the most probable place at each picture of one path through the whole walk",
                 &search_path, 0.9, true, &search_path_part},
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
