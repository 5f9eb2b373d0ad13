#include "place/trajectory/pose_fixes.hpp"

#include <algorithm>
#include <cmath>

namespace place {
namespace {

// Across the path, metres: of what a match's points say; and of a match whose points say nothing while those
// of others do: a walker who stays a metre to one side does so there too.
constexpr double kSeenAside_m = 0.12, kUnseenAside_m = 1;
constexpr std::ptrdiff_t kFewestSeen = 3;  // matches that say so, before the others count as unseen

/// Where the walker was, as far as was seen: beside and ahead of the reference.
vo::Pose2 moved_aside(vo::Pose2 pose, const Match& match) {
  const double lateral_m = match.lateral_m.value_or(0), ahead_m = match.ahead_m.value_or(0);
  const double s = std::sin(pose.heading_rad), c = std::cos(pose.heading_rad);
  pose.x_m += lateral_m * c + ahead_m * s;
  pose.y_m += ahead_m * c - lateral_m * s;
  return pose;
}

}  // namespace

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
  const auto is_seen = [](const Match& match) { return match.accepted && match.lateral_m; };
  const bool any_seen = std::ranges::count_if(matches, is_seen) >= kFewestSeen;
  const auto aside_sd_m = [&](const Match& match) -> std::optional<double> {
    if (match.lateral_m) return kSeenAside_m;
    return any_seen ? std::optional(kUnseenAside_m) : std::nullopt;
  };
  const bool surveyed = route.traverses[*result.traverse].surveyed;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!says_where(matches[i])) continue;
    const std::size_t on = index_of(matches[i]);
    if (surveyed ? route.traverses[on].surveyed : on == *result.traverse)
      result.fixes.push_back({.node = i,
                              .pose = moved_aside(*matches[i].place->pose, matches[i]),
                              .score = matches[i].score,
                              .probability = matches[i].probability,
                              .sd_m = matches[i].sd_m,
                              .aside_sd_m = aside_sd_m(matches[i])});
  }
  return result;
}

}  // namespace place
