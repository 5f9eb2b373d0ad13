#include "stored_run.hpp"

#include "memory_limit.hpp"

#include <exception>
#include <new>

#include <nlohmann/json.hpp>

#include <place/match/stored_search.hpp>
#include <place/route/route_database.hpp>
#include <vo/base/error.hpp>

namespace retrace {

using nlohmann::ordered_json;

std::optional<StoredRun> stored_run(LaunchedTeam* team, const std::string& memory) {
  if (memory.empty()) return team != nullptr ? std::optional(StoredRun{team, {}}) : std::nullopt;
  const std::size_t bytes = bytes_of(memory);
  if (team != nullptr) throw vo::Error("--memory", "has no effect on several processes", "more of them");
  limit_memory(bytes);
  return StoredRun{nullptr, bytes};
}

void run_as_team(LaunchedTeam& team, const std::function<void()>& first, const std::function<void()>& serve) {
  try {
    if (team.rank() > 0) return serve();
    first();
    team.exchange({});  // the others may end
  } catch (const std::bad_alloc&) {
    team.fail("out of memory; expected more processes, or more memory for each");
    if (team.rank() == 0) throw;
  } catch (const std::exception& error) {
    team.fail(error.what());
    if (team.rank() == 0) throw;  // one line is enough
  }
}

void read_matched_previews(const std::string& path, const std::vector<place::Match>& matches,
                           place::Route& route) {
  for (std::size_t i = 0; i < route.traverses.size(); ++i) {
    std::vector<std::size_t> keyframes;
    for (const place::Match& match : matches)
      if (match.place && match.place->traverse == route.traverses[i].name)
        keyframes.push_back(match.place->keyframe);
    place::read_previews(path, route, i, keyframes);
  }
}

ordered_json shards_of_team(place::Team& team, MatrixKeeper& keeper, std::uint64_t bytes_read,
                            std::uint64_t bytes_sent) {
  ordered_json json = ordered_json::array();
  if (team.size() == 1) return json;
  keeper.join(team);
  const std::string mine =
      ordered_json{{"descriptor_bytes_read", bytes_read}, {"message_bytes", bytes_sent}}.dump();
  for (const place::Team::Message& other :
       team.collect({reinterpret_cast<const std::uint8_t*>(mine.data()), mine.size()}))
    json.push_back(ordered_json::parse(other.begin(), other.end()));
  return json;
}

void serve_run(const std::string& route_path, LaunchedTeam& team, bool whole_matrices) {
  MatrixKeeper keeper(whole_matrices);
  const std::uint64_t bytes_read = place::serve_shards(
      route_path, team,
      [&](const place::SearchPart& part, std::size_t keyframes) { keeper.take(part, keyframes); });
  shards_of_team(team, keeper, bytes_read, team.bytes_sent());
  team.exchange({});  // until the first has written all
}

}  // namespace retrace
