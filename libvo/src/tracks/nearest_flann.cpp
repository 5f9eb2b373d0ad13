#include "tracks/nearest.hpp"

#include <algorithm>

#include <flann/flann.hpp>

namespace vo {
namespace {

std::vector<std::size_t> points_of(const Features& features, std::int8_t laplacian) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < features.size(); ++i)
    if (features.points[i].laplacian == laplacian) points.push_back(i);
  return points;
}

std::vector<float> rows_of(const Features& features, const std::vector<std::size_t>& points) {
  std::vector<float> rows;
  rows.reserve(points.size() * features.descriptor_size);
  for (const std::size_t i : points) {
    const auto descriptor = features.descriptor(i);
    rows.insert(rows.end(), descriptor.begin(), descriptor.end());
  }
  return rows;
}

std::vector<Nearest> search(const Features& from, const Features& to) {
  std::vector<Nearest> nearest(from.size());
  for (const std::int8_t laplacian : {std::int8_t{-1}, std::int8_t{1}}) {
    const auto queries = points_of(from, laplacian), references = points_of(to, laplacian);
    if (queries.empty() || references.empty()) continue;
    auto query_rows = rows_of(from, queries), reference_rows = rows_of(to, references);
    const flann::Matrix<float> query(query_rows.data(), queries.size(), from.descriptor_size);
    const flann::Matrix<float> reference(reference_rows.data(), references.size(), from.descriptor_size);
    // A single tree: FLANN's randomised ones draw from the machine's own entropy, and never repeat.
    flann::Index<flann::L2<float>> index(reference, flann::KDTreeSingleIndexParams());
    index.buildIndex();
    const std::size_t count = std::min<std::size_t>(2, references.size());
    std::vector<std::size_t> indices(queries.size() * count);
    std::vector<float> distances(queries.size() * count);
    flann::Matrix<std::size_t> index_matrix(indices.data(), queries.size(), count);
    flann::Matrix<float> distance_matrix(distances.data(), queries.size(), count);
    flann::SearchParams params;
    params.cores = 1;
    index.knnSearch(query, index_matrix, distance_matrix, count, params);
    for (std::size_t q = 0; q < queries.size(); ++q) {
      for (std::size_t k = 0; k < count; ++k)
        nearest[queries[q]].offer(references[indices[q * count + k]], distances[q * count + k]);
    }
  }
  return nearest;
}

}  // namespace

NearestOfBoth nearest_flann(const Features& from, const Features& to) {
  NearestOfBoth nearest{.from = search(from, to)};
  for (const Nearest& back : search(to, from)) nearest.to.push_back(back.first);
  return nearest;
}

}  // namespace vo
