#include "gait/nearest.hpp"
#include "kernels/kernels.hpp"
#include "vo/base/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace vo {
namespace {

constexpr std::size_t kQueries = 4;     // of one kernel call
constexpr std::size_t kReferences = 8;  // of one kernel call
constexpr std::size_t kGroups = 16;     // of queries, in one task

/// The points of one laplacian sign, from the top of the image down.
std::vector<std::size_t> points_of(const Features& features, std::int8_t laplacian) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (features.points[i].laplacian == laplacian) points.push_back(i);
  std::ranges::stable_sort(points, {}, [&](std::size_t i) { return features.points[i].y_px; });
  return points;
}

float squared_length(std::span<const float> values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0F);
}

/// Descriptors in the kernel's order, `group` of them at a time; the last group is filled up with zeros.
struct Packed {
  std::vector<std::size_t> points;
  std::vector<float> values, norms;

  Packed(const Features& features, std::int8_t laplacian, std::size_t group, bool transposed)
      : points(points_of(features, laplacian)) {
    const std::size_t size = features.descriptor_size;
    norms.resize((points.size() + group - 1) / group * group);
    values.resize(norms.size() * size);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto descriptor = features.descriptor(points[p]);
      norms[p] = squared_length(descriptor);
      for (std::size_t k = 0; k < size; ++k)
        values[transposed ? (p / group * size + k) * group + p % group : p * size + k] = descriptor[k];
    }
  }
};

class Search {
 public:
  Search(const Features& from, const Features& to, const MatchOptions& options)
      : from_(from),
        to_(to),
        mutual_(options.mutual),
        reach_px_(options.max_displacement_px > 0 ? options.max_displacement_px
                                                  : std::numeric_limits<double>::infinity()) {}

  void run(std::int8_t laplacian, NearestOfBoth& nearest) const {
    const Packed queries(from_, laplacian, kQueries, false), references(to_, laplacian, kReferences, true);
    const std::size_t groups = queries.norms.size() / kQueries;
    const std::size_t tasks = (groups + kGroups - 1) / kGroups;
    std::vector<std::vector<Nearest>> rivals(tasks);
    parallel_for(tasks, [&](std::size_t task) {
      rivals[task].resize(mutual_ ? references.points.size() : 0);
      for (std::size_t g = task * kGroups; g < std::min((task + 1) * kGroups, groups); ++g)
        search_group(queries, references, g, nearest.from, rivals[task]);
    });
    for (const auto& part : rivals) {
      for (std::size_t r = 0; r < part.size(); ++r) nearest.to[references.points[r]].merge(part[r]);
    }
  }

 private:
  void search_group(const Packed& queries, const Packed& references, std::size_t group,
                    std::vector<Nearest>& nearest, std::vector<Nearest>& rivals) const {
    const std::size_t first = group * kQueries, count = std::min(kQueries, queries.points.size() - first);
    const double top = from_.points[queries.points[first]].y_px - reach_px_;
    const double bottom = from_.points[queries.points[first + count - 1]].y_px + reach_px_;
    std::array<std::array<float, kReferences>, kQueries> distances;
    for (std::size_t r = 0; r < references.points.size(); r += kReferences) {
      const std::size_t width = std::min(kReferences, references.points.size() - r);
      if (to_.points[references.points[r + width - 1]].y_px < top) continue;
      if (to_.points[references.points[r]].y_px > bottom) break;
      kernels::kernels().squared_distances(
          {.query = queries.values.data() + first * from_.descriptor_size,
           .query_norms = queries.norms.data() + first,
           .packed = references.values.data() + r * from_.descriptor_size,
           .reference_norms = references.norms.data() + r,
           .size = from_.descriptor_size,
           .out = {distances[0].data(), distances[1].data(), distances[2].data(), distances[3].data()}});
      for (std::size_t q = 0; q < count; ++q) {
        const std::size_t i = queries.points[first + q];
        for (std::size_t k = 0; k < width; ++k) {
          const std::size_t j = references.points[r + k];
          if (!candidates(from_.points[i], to_.points[j])) continue;
          nearest[i].offer(j, distances[q][k]);
          if (mutual_) rivals[r + k].offer(i, distances[q][k]);
        }
      }
    }
  }

  [[nodiscard]] bool candidates(const Feature& a, const Feature& b) const {
    const double dx = a.x_px - b.x_px, dy = a.y_px - b.y_px;
    return dx * dx + dy * dy <= reach_px_ * reach_px_;
  }

  const Features& from_;
  const Features& to_;
  bool mutual_;
  double reach_px_;
};

}  // namespace

NearestOfBoth nearest_exact(const Features& from, const Features& to, const MatchOptions& options) {
  NearestOfBoth nearest{.from = std::vector<Nearest>(from.size()),
                        .to = std::vector<Nearest>(options.mutual ? to.size() : 0)};
  const Search search(from, to, options);
  for (const std::int8_t laplacian : {std::int8_t{-1}, std::int8_t{1}}) search.run(laplacian, nearest);
  return nearest;
}

}  // namespace vo
