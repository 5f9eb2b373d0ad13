#include "kernels/kernels.hpp"
#include "tracks/nearest.hpp"
#include "vo/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace vo {
namespace {

constexpr std::size_t kGroup = kernels::kLanes;  // points of one kernel call
constexpr std::size_t kTaskGroups = 16;          // groups of queries in one task
constexpr float kFar = std::numeric_limits<float>::infinity();

/// The points of one Laplacian sign from the top of the image down, in groups.
struct Packed {
  std::vector<std::size_t> points;
  std::vector<float> values, norms, x_px, y_px;

  /// The values of a group lie row by row, or `side_by_side`.
  Packed(const Features& features, std::int8_t laplacian, bool side_by_side) {
    for (std::size_t i = 0; i < features.size(); ++i)
      if (features.points[i].laplacian == laplacian) points.push_back(i);
    std::ranges::stable_sort(points, {}, [&](std::size_t i) { return features.points[i].y_px; });
    const std::size_t size = features.descriptor_size;
    norms.resize((points.size() + kGroup - 1) / kGroup * kGroup, kFar);
    x_px.resize(norms.size());
    y_px.resize(norms.size());
    values.resize(norms.size() * size);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto descriptor = features.descriptor(points[p]);
      norms[p] = std::inner_product(descriptor.begin(), descriptor.end(), descriptor.begin(), 0.0F);
      x_px[p] = features.points[points[p]].x_px;
      y_px[p] = features.points[points[p]].y_px;
      float* to = values.data() + p / kGroup * kGroup * size + p % kGroup * (side_by_side ? 1 : size);
      for (std::size_t k = 0; k < size; ++k) to[side_by_side ? k * kGroup : k] = descriptor[k];
    }
  }

  [[nodiscard]] kernels::PointBlock block(std::size_t first, std::size_t size) const {
    return {.values = values.data() + first * size,
            .norms = norms.data() + first,
            .x_px = x_px.data() + first,
            .y_px = y_px.data() + first};
  }
};

/// Finds the nearest reference of each query of a group; `minima`: the least distance of each reference.
void search_group(const Packed& queries, const Packed& references, std::size_t first, std::size_t size,
                  float reach_px, std::vector<Nearest>& nearest, std::vector<float>& minima) {
  const std::size_t count = std::min(kGroup, queries.points.size() - first);
  const float top = queries.y_px[first] - reach_px, bottom = queries.y_px[first + count - 1] + reach_px;
  std::array<float, kGroup> limits;
  limits.fill(std::numeric_limits<float>::max());
  std::array<unsigned, kGroup> within;
  float distances[kGroup][kGroup];
  for (std::size_t r = 0; r < references.points.size(); r += kGroup) {
    const std::size_t last = std::min(r + kGroup, references.points.size()) - 1;
    if (references.y_px[last] < top) continue;
    if (references.y_px[r] > bottom) break;
    kernels::kernels().squared_distances({.queries = queries.block(first, size),
                                          .references = references.block(r, size),
                                          .size = size,
                                          .squared_reach_px = reach_px * reach_px,
                                          .limits = limits.data(),
                                          .minima = minima.data() + r,
                                          .out = distances,
                                          .within = within.data()});
    for (std::size_t q = 0; q < count; ++q) {
      Nearest& best = nearest[queries.points[first + q]];
      for (unsigned bits = within[q]; bits != 0; bits &= bits - 1) {
        const auto k = static_cast<std::size_t>(std::countr_zero(bits));
        best.offer(references.points[r + k], distances[q][k]);
        limits[q] = std::min(limits[q], best.second);
      }
    }
  }
}

}  // namespace

NearestOfBoth nearest_exact(const Features& from, const Features& to, const MatchOptions& options) {
  NearestOfBoth nearest{.from = std::vector<Nearest>(from.size()), .to = std::vector<float>(to.size(), kFar)};
  const float reach_px =
      options.max_displacement_px > 0 ? static_cast<float>(options.max_displacement_px) : kFar;
  for (const std::int8_t laplacian : {std::int8_t{-1}, std::int8_t{1}}) {
    const Packed queries(from, laplacian, false), references(to, laplacian, true);
    const std::size_t groups = queries.norms.size() / kGroup;
    std::vector<std::vector<float>> minima((groups + kTaskGroups - 1) / kTaskGroups);
    parallel_for(minima.size(), [&](std::size_t task) {
      minima[task].resize(references.norms.size(), kFar);
      for (std::size_t g = task * kTaskGroups; g < std::min((task + 1) * kTaskGroups, groups); ++g) {
        search_group(queries, references, g * kGroup, from.descriptor_size, reach_px, nearest.from,
                     minima[task]);
      }
    });
    for (const auto& part : minima) {
      for (std::size_t r = 0; r < references.points.size(); ++r)
        nearest.to[references.points[r]] = std::min(nearest.to[references.points[r]], part[r]);
    }
  }
  return nearest;
}

}  // namespace vo
