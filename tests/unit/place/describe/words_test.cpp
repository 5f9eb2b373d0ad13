#include "place/describe/words.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using place::FloatRows;
using place::learn_words;
using place::make_float_rows;
using place::nearest_words;

/// 60 points within 0.1 of each of (0, 0), (10, 0) and (0, 10), in turn.
FloatRows three_heaps() {
  vo::Rng rng(3);
  FloatRows points = make_float_rows(2, 180);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i][0] = static_cast<float>((i % 3 == 1 ? 10 : 0) + rng.uniform(-0.1, 0.1));
    points[i][1] = static_cast<float>((i % 3 == 2 ? 10 : 0) + rng.uniform(-0.1, 0.1));
  }
  return points;
}

TEST(Words, AreTheMiddlesOfHeaps) {
  const FloatRows points = three_heaps();
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const FloatRows words = learn_words(points, 3, seed);
    ASSERT_EQ(words.size(), 3U);
    for (std::size_t heap = 0; heap < 3; ++heap) {
      // The word nearest to a heap's first point is the mean of the heap.
      const auto word = words[nearest_words(points, words)[heap]];
      for (std::size_t k = 0; k < 2; ++k) {
        double mean = 0;
        for (std::size_t i = heap; i < points.size(); i += 3) mean += points[i][k] / 60;
        EXPECT_NEAR(word[k], mean, 1e-5);  // float sums of 60
      }
    }
  }
}

TEST(Words, AreTheSameForASeed) {
  const FloatRows points = three_heaps();
  EXPECT_EQ(learn_words(points, 5, 9).values, learn_words(points, 5, 9).values);
}

TEST(Words, AreTheVectorsWhereThereAreFew) {
  const FloatRows two{.width = 2, .values = {1, 2, 3, 4}};
  EXPECT_EQ(learn_words(two, 16, 1).values, two.values);
  EXPECT_EQ(learn_words({.width = 2, .values = {1, 2}}, 16, 1).size(), 1U);
}

TEST(Words, OfEqualVectorsAreThatVector) {
  const FloatRows words = learn_words({.width = 2, .values = std::vector<float>(80, 5)}, 4, 1);
  ASSERT_GE(words.size(), 1U);
  EXPECT_THAT(words.values, testing::Each(5.0F));
}

TEST(Words, RefuseNoVectors) {
  EXPECT_THROW(learn_words({}, 4, 1), std::invalid_argument);
  EXPECT_THROW(learn_words({.width = 1, .values = {1}}, 0, 1), std::invalid_argument);
}

TEST(NearestWords, AreTheFirstOfEquals) {
  const FloatRows words{.width = 1, .values = {4, 2, 2, 0}};
  EXPECT_THAT(nearest_words({.width = 1, .values = {2.125F, 3, 100, -1}}, words),
              testing::ElementsAre(1, 0, 0, 3));
  EXPECT_TRUE(nearest_words({.width = 1, .values = {}}, words).empty());
}

TEST(NearestWords, AreThoseOfTheLeastDistance) {
  vo::Rng rng(8);
  FloatRows vectors = make_float_rows(7, 50), words = make_float_rows(7, 9);
  for (FloatRows* rows : {&vectors, &words})
    for (float& value : rows->values) value = static_cast<float>(rng.uniform(-1, 1));
  const std::vector<std::size_t> nearest = nearest_words(vectors, words);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const auto distance = [&](std::size_t word) {
      double sum = 0;
      for (std::size_t k = 0; k < 7; ++k) sum += std::pow(double{vectors[i][k]} - words[word][k], 2);
      return sum;
    };
    for (std::size_t word = 0; word < words.size(); ++word)
      EXPECT_LE(distance(nearest[i]), distance(word) + 1e-5);  // float products of values up to 1
  }
}

TEST(NearestWords, RefuseWordsOfAnotherSize) {
  EXPECT_THROW(nearest_words({.width = 2, .values = {1, 2}}, {.width = 1, .values = {1}}),
               std::invalid_argument);
  EXPECT_THROW(nearest_words({.width = 2, .values = {1, 2}}, {.width = 2, .values = {}}),
               std::invalid_argument);
}

}  // namespace
