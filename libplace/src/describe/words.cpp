#include "place/describe/words.hpp"

#include "place/describe/row_products.hpp"

#include <algorithm>
#include <stdexcept>

#include <flann/flann.hpp>

namespace place {
namespace {

constexpr std::size_t kOfEachWord = 150;  // vectors that words start from
constexpr int kRounds = 5;                // on all vectors; more rounds hardly change anything

/// Every n-th vector; all for n of 0 or 1.
std::vector<float> every_nth(const FloatRows& vectors, std::size_t n) {
  if (n <= 1) return vectors.values;
  std::vector<float> chosen;
  for (std::size_t i = 0; i < vectors.size(); i += n)
    chosen.insert(chosen.end(), vectors[i].begin(), vectors[i].end());
  return chosen;
}

/// Moves every word to the mean of the vectors nearest to it (Lloyd 1982); one without any stays.
void to_middles(const FloatRows& vectors, FloatRows& words) {
  const std::vector<std::size_t> nearest = nearest_words(vectors, words);
  std::vector<double> sums(words.values.size());
  std::vector<std::size_t> members(words.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    double* const sum = sums.data() + nearest[i] * words.width;
    ++members[nearest[i]];
    for (std::size_t k = 0; k < words.width; ++k) sum[k] += vectors[i][k];
  }
  for (std::size_t word = 0; word < words.size(); ++word)
    for (std::size_t k = 0; k < words.width && members[word] > 0; ++k)
      words[word][k] = static_cast<float>(sums[word * words.width + k] / static_cast<double>(members[word]));
}

}  // namespace

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
  // FLANN's loops on a share of the vectors find the clusters; products of matrices on all of them find their
  // centres.
  points = every_nth(vectors, vectors.size() / std::max(count * kOfEachWord, std::size_t{1}));
  const std::size_t some = points.size() / vectors.width;
  words = make_float_rows(vectors.width, count);
  flann::Matrix<float> centres(words.values.data(), count, vectors.width);
  constexpr int kIterations = 20;
  flann::seed_random(seed);
  const flann::KMeansIndexParams params(static_cast<int>(count), kIterations, flann::FLANN_CENTERS_KMEANSPP);
  const int found = flann::hierarchicalClustering<flann::L2<float>>(
      flann::Matrix<float>(points.data(), some, vectors.width), centres, params);
  words.values.resize(static_cast<std::size_t>(found) * vectors.width);
  for (int i = 0; i < kRounds; ++i) to_middles(vectors, words);
  return words;
}

std::vector<std::size_t> nearest_words(const FloatRows& vectors, const FloatRows& words) {
  if (words.size() == 0 || words.width != vectors.width)
    throw std::invalid_argument("nearest_words: words of the vectors' size expected");
  // |v - w|^2 minus |v|^2, which is the same for all words.
  const FloatRows products = RowPanels(words).products(vectors);
  std::vector<float> squares(words.size());
  for (std::size_t word = 0; word < words.size(); ++word)
    for (const float value : words[word]) squares[word] += value * value;
  std::vector<std::size_t> nearest(vectors.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const auto distance = [&](std::size_t word) { return squares[word] - 2 * products[i][word]; };
    for (std::size_t word = 1; word < words.size(); ++word)
      if (distance(word) < distance(nearest[i])) nearest[i] = word;
  }
  return nearest;
}

}  // namespace place
