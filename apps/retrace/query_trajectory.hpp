#pragma once

#include "settings.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <place/localiser.hpp>
#include <place/route/route_position.hpp>

namespace retrace {

/// A query walk in the route's coordinates, a pose for each of its keyframes.
struct QueryTrajectory {
  /// Why there is no corrected trajectory; empty if there is one. Only accepted matches' poses say then where
  /// the walker was.
  std::string why_not;
  bool asked_for = true;  ///< a correction was to be made: the reason is a warning

  std::optional<std::size_t> traverse;  ///< that the positions are along
  std::vector<place::PoseFix> fixes;    ///< accepted matches with poses, by keyframe
  vo::Trajectory odometry;              ///< before, laid where the corrected one begins
  place::CorrectedWalk corrected;
  std::vector<place::RoutePosition> on_route;
};

/// True if the route has poses that a query could be put among.
bool has_poses(const place::Route& route);

/// How many of the matches used the correction bears out.
std::size_t matches_believed(const QueryTrajectory& trajectory);

/// Corrects the drift of the walk's odometry by its matches, if the settings ask for it. Where the correction
/// lets go more than two thirds of the matches, it is not to be trusted, and there is none.
QueryTrajectory query_trajectory(const place::Route& route, const vo::Walk& walk,
                                 const place::SampledWalk& sampled, const std::vector<place::Match>& matches,
                                 const Settings& settings);

/// The same of odometry at hand: a pose for each match.
QueryTrajectory query_trajectory(const place::Route& route, const std::vector<place::Match>& matches,
                                 const vo::Trajectory& odometry);

/// Writes trajectory.tum: the corrected poses, or else those of accepted matches. With a correction also
/// trajectory_odometry.tum and trajectory.csv, and trajectory.geojson and .gpx where the route has an origin;
/// those not written are removed, since they would be another run's.
void write_trajectory(const QueryTrajectory& trajectory, const place::Route& route,
                      const std::vector<place::Match>& matches, const std::filesystem::path& folder);

}  // namespace retrace
