#include "place/trajectory/pose_fixes.hpp"

#include <algorithm>

namespace place {

RouteFixes pose_fixes(const Route& route, const std::vector<Match>& matches) {
  const auto index_of = [&](const Match& match) {
    return static_cast<std::size_t>(
        std::ranges::find(route.traverses, match.place->traverse, &Traverse::name) - route.traverses.begin());
  };
  const auto says_where = [](const Match& match) {
    return match.accepted && match.place && match.place->pose;
  };
  std::vector<std::size_t> count(route.traverses.size(), 0);
  for (const Match& match : matches)
    if (says_where(match)) ++count[index_of(match)];

  // The traverse with most matches among the surveyed ones, else among all.
  RouteFixes result;
  for (const bool surveyed : {true, false}) {
    for (std::size_t i = 0; i < count.size(); ++i) {
      if (count[i] == 0 || route.traverses[i].surveyed != surveyed) continue;
      if (!result.traverse || count[i] > count[*result.traverse]) result.traverse = i;
    }
    if (result.traverse) break;
  }
  if (!result.traverse) return result;
  const bool surveyed = route.traverses[*result.traverse].surveyed;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!says_where(matches[i])) continue;
    const std::size_t on = index_of(matches[i]);
    if (surveyed ? route.traverses[on].surveyed : on == *result.traverse)
      result.fixes.push_back({.node = i,
                              .pose = *matches[i].place->pose,
                              .score = matches[i].score,
                              .probability = matches[i].probability,
                              .sd_m = matches[i].sd_m});
  }
  return result;
}

}  // namespace place
