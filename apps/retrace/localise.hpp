#pragma once

#include "settings.hpp"

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include <place/localiser.hpp>

namespace retrace {

/// A walk found on a route, as written to a run's folder.
struct LocalisedWalk {
  place::Localisation found;
  nlohmann::ordered_json summary;  ///< what is in summary.json
};

/// Samples a walk as the settings say, finds it on the route, and writes matches.csv, trajectory.tum,
/// summary.json, config.toml, report.html and the pictures of the cost matrices into `folder`, which is
/// there; with `save_matrices` also the matrices themselves. `route_path` is what the summary calls the
/// route.
LocalisedWalk localise_walk(const place::Route& route, const std::string& route_path, const vo::Walk& walk,
                            const Settings& settings, const std::filesystem::path& folder,
                            bool save_matrices = false);

}  // namespace retrace
