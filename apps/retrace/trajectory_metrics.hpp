#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace retrace {

/// Errors of a run's trajectories against the truth of the query: `ape_*` and `rpe_*` of trajectory.tum as
/// evo defines them, without and with alignment, `ape_odometry_*` of trajectory_odometry.tum, and the share
/// of poses within the 90 % ellipse of trajectory.csv. Anything that the run lacks is null. `query_truth`:
/// truth.csv.
nlohmann::ordered_json trajectory_metrics(const std::filesystem::path& folder,
                                          const std::string& query_truth);

}  // namespace retrace
