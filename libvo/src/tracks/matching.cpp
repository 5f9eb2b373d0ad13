#include "vo/tracks/matching.hpp"

#include "tracks/nearest.hpp"

#include <cmath>
#include <stdexcept>

namespace vo {
namespace {

double squared_displacement(const Feature& a, const Feature& b) {
  const double dx = a.x_px - b.x_px, dy = a.y_px - b.y_px;
  return dx * dx + dy * dy;
}

}  // namespace

std::vector<Match> match_features(const Features& from, const Features& to, const MatchOptions& options) {
  if (!(options.max_ratio > 0 && options.max_ratio <= 1))
    throw std::invalid_argument("match_features: max_ratio must be in (0, 1]");
  if (!(options.max_displacement_px >= 0))
    throw std::invalid_argument("match_features: max_displacement_px must be >= 0");
  std::vector<Match> matches;
  if (from.size() == 0 || to.size() == 0) return matches;
  if (from.descriptor_size != to.descriptor_size)
    throw std::invalid_argument("match_features: descriptors of one size expected");

  const NearestOfBoth nearest =
      options.search == MatchSearch::kExact ? nearest_exact(from, to, options) : nearest_flann(from, to);
  const double ratio = options.max_ratio * options.max_ratio;
  const double reach = options.max_displacement_px * options.max_displacement_px;
  std::vector<bool> taken(to.size(), false);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Nearest& best = nearest.from[i];
    if (best.index == Nearest::kNone) continue;
    if (options.max_ratio < 1 && best.first > ratio * best.second) continue;
    if (options.mutual && (taken[best.index] || best.first > nearest.to[best.index])) continue;
    if (reach > 0 && squared_displacement(from.points[i], to.points[best.index]) > reach) continue;
    taken[best.index] = true;
    matches.push_back({i, best.index, std::sqrt(best.first)});
  }
  return matches;
}

}  // namespace vo
