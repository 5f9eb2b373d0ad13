#include "match/joined_traverses.hpp"

#include "place/match/traverse_fusion.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace place {
namespace {

/// The places of each traverse's keyframes on every other one: at [of][on].
std::vector<std::vector<TraverseMap>> maps_between(const Route& route, const RouteMatchingOptions& options,
                                                   std::vector<std::string>& warnings) {
  const std::size_t count = route.traverses.size();
  std::vector<std::vector<TraverseMap>> maps(count, std::vector<TraverseMap>(count));
  RouteMatchingOptions all = options;
  all.candidate_use = CandidateUse::kNever;
  for (std::size_t of = 0; of < count; ++of) {
    SampledWalk walk;
    walk.descriptors = route.traverses[of].descriptors;
    for (std::size_t on = 0; on < of; ++on) {
      const int length = sequence_length_on(route.traverses[on], options);
      const TraverseCosts costs = costs_against(walk, route.traverses[on], on, all, length, {});
      const SureMatches matches = search_surely(
          costs.enhanced, search_method("path"),
          {.sequence = {.length = length},
           .graph = {},
           .path = {},
           .gaps = {.query = gaps_of(route.traverses[of]), .reference = gaps_of(route.traverses[on])}});
      maps[of][on] = map_from_matches(matches.matches);
      maps[on][of] = inverse_map(maps[of][on], route.traverses[on].keyframes.size());
      if (std::ranges::none_of(maps[of][on], [](const auto& at) { return at.has_value(); })) {
        warnings.push_back(
            fmt::format("traverses '{}' and '{}' share no place that is surely the same: they "
                        "are searched apart",
                        route.traverses[on].name, route.traverses[of].name));
      }
    }
  }
  return maps;
}

/// A map between compared columns instead of keyframes.
TraverseMap between_columns(const TraverseMap& map, const std::vector<std::size_t>& from,
                            const std::vector<std::size_t>& to) {
  TraverseMap result(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::optional<double>& at = map[from[i]];
    if (!at) continue;
    const auto low = static_cast<std::size_t>(*at);
    const auto column = std::ranges::lower_bound(to, low);
    if (column == to.end() || *column != low) continue;
    const double share = *at - static_cast<double>(low);
    const bool goes_on = column + 1 != to.end() && *(column + 1) == low + 1;
    result[i] = static_cast<double>(column - to.begin()) + (goes_on ? share : 0);
  }
  return result;
}

}  // namespace

std::vector<CostMatrix> joined_traverses(const Route& route, const std::vector<TraverseCosts>& costs,
                                         const RouteMatchingOptions& options,
                                         std::vector<std::string>& warnings) {
  const auto maps = maps_between(route, options, warnings);
  std::vector<CostMatrix> result;
  for (std::size_t of = 0; of < costs.size(); ++of) {
    std::vector<TraverseMap> onto;
    for (std::size_t on = 0; on < costs.size(); ++on)
      onto.push_back(of == on ? TraverseMap()
                              : between_columns(maps[of][on], costs[of].columns, costs[on].columns));
    std::vector<FurtherCosts> further;
    for (std::size_t on = 0; on < costs.size(); ++on)
      if (of != on) further.push_back({&costs[on].enhanced, &onto[on]});
    fuse_traverses(result.emplace_back(costs[of].enhanced), further);
  }
  return result;
}

}  // namespace place
