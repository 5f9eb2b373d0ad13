#pragma once

#include "launched_team.hpp"
#include "report/kept_matrices.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <place/match/match.hpp>
#include <place/route/route.hpp>

namespace retrace {

/// A search of descriptors that stay in the route database, so that the route is read without them.
struct StoredRun {
  LaunchedTeam* team = nullptr;             ///< processes that divide it; null: this one alone
  std::optional<std::size_t> memory_bytes;  ///< see `place::StoredSearch`
};

/// The search of a team (null: none) or within `--memory` (empty: not given), to which the process is then
/// limited; none if the route is searched in memory. Throws `vo::Error` for an amount that is none, and for
/// one beside a team.
std::optional<StoredRun> stored_run(LaunchedTeam* team, const std::string& memory);

/// One run by all processes of a team: the first one does `first`, the others serve it. All end together: an
/// error of one ends the others too, and only the first throws it.
void run_as_team(LaunchedTeam& team, const std::function<void()>& first, const std::function<void()>& serve);

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
