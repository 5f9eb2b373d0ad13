#pragma once

#include "place/describe/descriptor.hpp"
#include "place/match/search_options.hpp"
#include "place/match/team.hpp"
#include "place/settings.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace place {

/// What the first member of a team asks all of them to do.
struct ShardRequest {
  enum class Task : std::uint64_t {
    kSettings,  ///< use these settings from now on
    kProject,   ///< project a traverse's descriptors for a shortlist
    kCosts,     ///< costs of keyframes
    kSearch,    ///< a search
    kDone,      ///< nothing more
  };
  Task task = Task::kDone;
  Settings settings;
  std::optional<std::int64_t> route_digest;  ///< with settings: of the route that the first member has read
  std::size_t traverse = 0;
  std::vector<Descriptors> query;    ///< comparable, of each kind that is compared
  std::vector<std::size_t> columns;  ///< keyframes, increasing; of a search none: all
  SearchOptions search;
};

Team::Message message_of(const ShardRequest& request);
ShardRequest read_request(const Team::Message& message);

}  // namespace place
