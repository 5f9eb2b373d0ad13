#include "place/describe/words.hpp"

#include <stdexcept>

#include <Eigen/Core>
#include <flann/flann.hpp>

namespace place {

FloatRows learn_words(const FloatRows& vectors, std::size_t count, std::uint32_t seed) {
  if (vectors.size() == 0 || count == 0)
    throw std::invalid_argument("learn_words: vectors and words expected");
  std::vector<float> points = vectors.values;
  std::vector<float> first(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(vectors.width));
  FloatRows words{.width = vectors.width, .values = std::move(first)};
  if (count == 1 || vectors.size() <= count) {
    if (count > 1) words.values = std::move(points);
    return words;
  }
  words = make_float_rows(vectors.width, count);
  flann::Matrix<float> centres(words.values.data(), count, vectors.width);
  constexpr int kIterations = 20;  // the clusters of some ten thousand blocks hardly change any more
  flann::seed_random(seed);
  const flann::KMeansIndexParams params(static_cast<int>(count), kIterations, flann::FLANN_CENTERS_KMEANSPP);
  const int found = flann::hierarchicalClustering<flann::L2<float>>(
      flann::Matrix<float>(points.data(), vectors.size(), vectors.width), centres, params);
  words.values.resize(static_cast<std::size_t>(found) * vectors.width);
  return words;
}

std::vector<std::size_t> nearest_words(const FloatRows& vectors, const FloatRows& words) {
  if (words.size() == 0 || words.width != vectors.width)
    throw std::invalid_argument("nearest_words: words of the vectors' size expected");
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto matrix = [](const FloatRows& rows) {
    return Eigen::Map<const Rows>(rows.values.data(), static_cast<Eigen::Index>(rows.size()),
                                  static_cast<Eigen::Index>(rows.width));
  };
  // |v - w|^2 less |v|^2, which is the same for all words.
  Rows distance = -2 * matrix(vectors) * matrix(words).transpose();
  distance.rowwise() += matrix(words).rowwise().squaredNorm().transpose();
  std::vector<std::size_t> nearest(vectors.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    Eigen::Index least = 0;
    distance.row(static_cast<Eigen::Index>(i)).minCoeff(&least);
    nearest[i] = static_cast<std::size_t>(least);
  }
  return nearest;
}

}  // namespace place
