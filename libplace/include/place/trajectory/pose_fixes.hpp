#pragma once

#include "place/match/match.hpp"
#include "place/route/route.hpp"
#include "place/trajectory/drift_correction.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace place {

/// The poses that accepted matches give a walk, for `correct_drift`, whose nodes are the query keyframes.
struct RouteFixes {
  std::vector<PoseFix> fixes;
  std::optional<std::size_t> traverse;  ///< the one with most of them; none without fixes
};

/// Surveys share their coordinates, but the odometry of two walks does not: fixes are on surveyed traverses
/// if any match is, else on the traverse with most matches. O(matches + traverses).
RouteFixes pose_fixes(const Route& route, const std::vector<Match>& matches);

}  // namespace place
