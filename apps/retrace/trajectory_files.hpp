#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <place/match/match.hpp>
#include <place/route/route.hpp>
#include <place/trajectory/query_trajectory.hpp>

namespace retrace {

/// The files that `write_trajectory` may write.
extern const std::vector<std::string> kTrajectoryFiles;

/// Writes trajectory.tum: the corrected poses, or else those of accepted matches. With a correction also
/// trajectory_odometry.tum and trajectory.csv. If the route is surveyed and has an origin, trajectory.geojson
/// and .gpx have the poses of trajectory.tum with the probabilities of their matches. Those not written are
/// removed, since they would belong to another run. `start_utc_s`: see `place::to_gpx`.
void write_trajectory(const place::QueryTrajectory& trajectory, const place::Route& route,
                      const std::vector<place::Match>& matches, const std::filesystem::path& folder,
                      std::optional<double> start_utc_s);

/// The same into a new folder, such as one of `StagedFiles`.
void put_trajectory(const place::QueryTrajectory& trajectory, const place::Route& route,
                    const std::vector<place::Match>& matches, const std::filesystem::path& folder,
                    std::optional<double> start_utc_s);

}  // namespace retrace
