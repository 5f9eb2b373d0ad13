#include "place/match/traverse_fusion.hpp"

#include "place/match/contrast_enhancement.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr std::size_t kFurthestApart = 10;  // keyframes between which places are interpolated

/// Known points (from, to) of a map, increasing in both; gaps between close ones are interpolated.
void fill_between(TraverseMap& map, std::span<const std::pair<std::size_t, double>> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [from, to] = points[i];
    map[from] = to;
    if (i == 0 || from - points[i - 1].first > kFurthestApart) continue;
    const auto& [from_before, to_before] = points[i - 1];
    for (std::size_t k = from_before + 1; k < from; ++k) {
      const double share = static_cast<double>(k - from_before) / static_cast<double>(from - from_before);
      map[k] = to_before + share * (to - to_before);
    }
  }
}

void check(const CostMatrix& base, std::span<const FurtherCosts> further) {
  for (const FurtherCosts& other : further) {
    const bool fits = other.enhanced != nullptr && other.map != nullptr &&
                      other.enhanced->queries == base.queries && other.map->size() == base.references;
    if (!fits || std::ranges::any_of(*other.map, [&](const std::optional<double>& at) {
          return at && !(*at >= 0 && *at <= static_cast<double>(other.enhanced->references) - 1);
        })) {
      throw std::invalid_argument("fuse_traverses: costs of the same queries and maps onto them expected");
    }
  }
}

}  // namespace

TraverseMap map_from_matches(std::span<const SureMatch> matches) {
  constexpr double kSure = 0.95;
  std::vector<std::pair<std::size_t, double>> points;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!(matches[i].probability.value_or(0) >= kSure)) continue;
    const auto at = static_cast<double>(*matches[i].match.reference);
    // The traverse cannot go back: two points that imply it are both rejected.
    if (!points.empty() && at < points.back().second) {
      points.pop_back();
      continue;
    }
    points.emplace_back(i, at);
  }
  TraverseMap map(matches.size());
  fill_between(map, points);
  return map;
}

TraverseMap inverse_map(const TraverseMap& map, std::size_t count) {
  std::vector<std::pair<std::size_t, double>> points;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (!map[i]) continue;
    const auto at = static_cast<std::size_t>(std::lround(*map[i]));
    if (at < count && (points.empty() || at > points.back().first))
      points.emplace_back(at, static_cast<double>(i));
  }
  TraverseMap inverse(count);
  fill_between(inverse, points);
  return inverse;
}

void fuse_traverses(CostMatrix& base, std::span<const FurtherCosts> further) {
  check(base, further);
  const bool none = std::ranges::all_of(further, [](const FurtherCosts& other) {
    return std::ranges::none_of(*other.map, [](const std::optional<double>& at) { return at.has_value(); });
  });
  if (none) return;
  std::vector<double> count(base.references, 1);
  for (const FurtherCosts& other : further) {
    for (std::size_t r = 0; r < base.references; ++r) count[r] += (*other.map)[r] ? 1 : 0;
  }
  vo::parallel_for(base.queries, [&](std::size_t q) {
    std::vector<double> likelihood(base.references);
    const std::span<float> costs = base.row(q);
    for (std::size_t r = 0; r < costs.size(); ++r) likelihood[r] = std::exp(-static_cast<double>(costs[r]));
    for (const FurtherCosts& other : further) {
      const std::span<const float> row = other.enhanced->row(q);
      for (std::size_t r = 0; r < costs.size(); ++r) {
        const std::optional<double>& at = (*other.map)[r];
        if (!at) continue;
        const float cost = std::min(row[static_cast<std::size_t>(std::floor(*at))],
                                    row[static_cast<std::size_t>(std::ceil(*at))]);
        likelihood[r] += std::exp(-static_cast<double>(cost));
      }
    }
    for (std::size_t r = 0; r < costs.size(); ++r)
      costs[r] = static_cast<float>(-std::log(likelihood[r] / count[r]));
  });
  enhance_contrast(base, {.method = Enhancement::kStandardise});
}

}  // namespace place
