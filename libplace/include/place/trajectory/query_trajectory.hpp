#pragma once

#include "place/match/match.hpp"
#include "place/route/route.hpp"
#include "place/route/route_position.hpp"
#include "place/trajectory/drift_correction.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vo/base/trajectory.hpp>

namespace place {

/// A query walk in the route's coordinates, a pose for each of its keyframes.
struct QueryTrajectory {
  /// Why there is no corrected trajectory; empty if there is one. Without it, only the poses of accepted
  /// matches show where the walker was.
  std::string why_not;

  std::optional<std::size_t> traverse;  ///< that positions refer to
  std::vector<PoseFix> fixes;           ///< accepted matches with poses, by keyframe
  vo::Trajectory odometry;              ///< uncorrected, moved to where the corrected one begins
  CorrectedWalk corrected;
  std::vector<RoutePosition> on_route;
};

/// The number of used matches that the correction confirms.
std::size_t matches_believed(const QueryTrajectory& trajectory);

/// Corrects the drift of a walk's odometry by its matches (PVO 6; `pose_fixes`, `correct_drift`). `odometry`:
/// a pose for each match; `gaps`: the matches right after gaps of the recording (`gaps_at`). A correction
/// that rejects more than two thirds of the matches is not trusted, and there is none. Throws
/// `std::invalid_argument` for another number of poses.
QueryTrajectory query_trajectory(const Route& route, const std::vector<Match>& matches,
                                 const vo::Trajectory& odometry, std::span<const std::size_t> gaps = {});

}  // namespace place
