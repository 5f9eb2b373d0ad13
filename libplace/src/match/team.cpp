#include "place/match/team.hpp"

#include <algorithm>

namespace place {

std::vector<Shard> shards_of(std::size_t count, std::size_t members) {
  const std::size_t blocks = (count + kShardBlock - 1) / kShardBlock;
  std::vector<Shard> shards;
  for (std::size_t i = 0; i < members; ++i) {
    const auto border = [&](std::size_t k) { return std::min(count, blocks * k / members * kShardBlock); };
    shards.push_back({border(i), border(i + 1)});
  }
  return shards;
}

}  // namespace place
