#pragma once

#include "place/match/match.hpp"
#include "place/route/route.hpp"
#include "place/trajectory/drift_correction.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace place {

/// Where accepted matches put a walk, for `correct_drift`, whose nodes are the query keyframes.
struct RouteFixes {
  std::vector<PoseFix> fixes;
  std::optional<std::size_t> traverse;  ///< the one that most of them are on; none without fixes
};

/// Poses of different surveys share their coordinates, but two walks' own odometry does not: fixes are on
/// surveyed traverses if any match is, else on the one that most matches are on. O(matches + traverses).
RouteFixes pose_fixes(const Route& route, const std::vector<Match>& matches);

}  // namespace place
