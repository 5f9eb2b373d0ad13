#pragma once

#include "report/kept_matrices.hpp"
#include "stored_run.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <place/place.hpp>

namespace retrace {

/// The files that `retrace localise` writes.
extern const std::vector<std::string> kRunFiles;

/// A run whose files are written.
struct WrittenRun {
  place::Run run;
  std::vector<KeptMatrix> matrices;  ///< one for each traverse
  std::string summary;               ///< contents of summary.json
};

/// Finds a walk on a route (`place::localise`) and writes all of a run into an existing folder: matches.csv,
/// the trajectories, summary.json, config.toml, the report and the cost matrix. `whole_matrices`: D.csv and
/// DD.csv too. `stored`: the route was read without descriptors and previews, and gets the previews that the
/// report shows. Warnings go to the log.
WrittenRun localise_into(const std::filesystem::path& folder, place::Route& route,
                         const std::string& route_path, const vo::Walk& walk, const place::Settings& settings,
                         bool whole_matrices = false, const StoredRun* stored = nullptr);

}  // namespace retrace
