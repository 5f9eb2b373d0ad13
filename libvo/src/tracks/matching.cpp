#include "vo/tracks/matching.hpp"

#include "tracks/nearest.hpp"

#include <cmath>
#include <stdexcept>

namespace vo {
std::vector<Match> match_features(const Features& from, const Features& to, const MatchOptions& options) {
  if (!(options.max_ratio > 0 && options.max_ratio <= 1))
    throw std::invalid_argument("match_features: max_ratio must be in (0, 1]");
  if (!(options.max_displacement_px >= 0))
    throw std::invalid_argument("match_features: max_displacement_px must be >= 0");
  std::vector<Match> matches;
  if (from.size() == 0 || to.size() == 0) return matches;
  if (from.descriptor_size != to.descriptor_size)
    throw std::invalid_argument("match_features: descriptors of one size expected");

  const NearestOfBoth nearest = nearest_exact(from, to, options);
  const double ratio = options.max_ratio * options.max_ratio;
  std::vector<bool> taken(to.size(), false);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Nearest& best = nearest.from[i];
    if (best.index == Nearest::kNone) continue;
    if (options.max_ratio < 1 && best.first > ratio * best.second) continue;
    if (options.mutual && (taken[best.index] || best.first > nearest.to[best.index])) continue;
    taken[best.index] = true;
    matches.push_back({i, best.index, std::sqrt(best.first)});
  }
  return matches;
}

}  // namespace vo
