#pragma once

#include "launched_team.hpp"
#include "report/kept_matrices.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/match/match.hpp>
#include <place/route/route.hpp>

namespace retrace {

/// A search of descriptors that stay in the route database.
struct StoredRun {
  place::Route* route = nullptr;            ///< the route, which gets the pictures that the report shows
  place::Team* team = nullptr;              ///< that divides it
  const LaunchedTeam* launched = nullptr;   ///< the same, if it is several processes
  std::optional<std::size_t> memory_bytes;  ///< see `place::StoredSearch`
};

/// Reads the pictures of the matched keyframes, for the report.
void read_matched_previews(const std::string& path, const std::vector<place::Match>& matches,
                           place::Route& route);

/// What each member of a team did, for the first; puts its parts of the matrices together. Empty for a team
/// of one.
nlohmann::ordered_json shards_of_team(place::Team& team, MatrixKeeper& keeper, std::uint64_t bytes_read,
                                      std::uint64_t bytes_sent);

/// What the other members of a team do while the first one is in `localise_into`.
void serve_run(const std::string& route_path, LaunchedTeam& team, bool whole_matrices);

}  // namespace retrace
