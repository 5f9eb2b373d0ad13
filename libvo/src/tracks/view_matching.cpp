#include "vo/tracks/view_matching.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace vo {
namespace {

constexpr int kNoDistance = std::numeric_limits<int>::max();

int squared_distance(const std::int8_t* a, const std::int8_t* b) {
  int sum = 0;
  for (std::size_t i = 0; i < ViewPoints::kValues; ++i) {
    const int off = a[i] - b[i];
    sum += off * off;
  }
  return sum;
}

/// The two nearest of a point.
struct TwoNearest {
  int first = kNoDistance, second = kNoDistance;
  std::size_t index = 0;

  void see(int distance, std::size_t i) {
    if (distance < first) {
      second = first;
      first = distance;
      index = i;
    } else if (distance < second) {
      second = distance;
    }
  }
};

}  // namespace

std::vector<ViewMatch> match_views(const ViewPoints& from, const ViewPoints& to,
                                   const ViewMatchOptions& options) {
  if (!(options.max_ratio > 0 && options.max_ratio <= 1))
    throw std::invalid_argument("match_views: max_ratio in (0, 1] expected");
  if (!(options.max_elevation_rad >= 0) || !(options.max_octaves >= 0))
    throw std::invalid_argument("match_views: max_elevation_rad and max_octaves of at least 0 expected");
  std::vector<TwoNearest> of_from(from.size()), of_to(to.size());
  for (std::size_t j = 0; j < to.size(); ++j) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      if (from.laplacian[i] != to.laplacian[j] ||
          std::abs(from.elevation_rad[i] - to.elevation_rad[j]) > options.max_elevation_rad ||
          std::abs(from.log2_size[i] - to.log2_size[j]) > options.max_octaves) {
        continue;
      }
      const int distance = squared_distance(from.descriptor(i).data(), to.descriptor(j).data());
      of_to[j].see(distance, i);
      of_from[i].see(distance, j);
    }
  }
  const double ratio = options.max_ratio * options.max_ratio;
  const auto stands_out = [&](const TwoNearest& nearest) {
    return nearest.second == kNoDistance ||
           (nearest.first < nearest.second && nearest.first <= ratio * nearest.second);
  };
  std::vector<ViewMatch> matches;
  for (std::size_t j = 0; j < to.size(); ++j) {
    const TwoNearest& nearest = of_to[j];
    if (nearest.first == kNoDistance || !stands_out(nearest)) continue;
    const TwoNearest& back = of_from[nearest.index];
    if (back.index == j && stands_out(back)) matches.push_back({nearest.index, j});
  }
  return matches;
}

}  // namespace vo
