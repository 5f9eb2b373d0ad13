#include "place/describe/vlad.hpp"

#include "place/describe/words.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using place::FloatRows;
using place::make_float_rows;
using place::vlad_columns;
using place::VladGrid;

FloatRows random_rows(std::size_t width, std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  FloatRows rows = make_float_rows(width, count);
  for (float& value : rows.values) value = static_cast<float>(rng.uniform(-1, 1));
  return rows;
}

TEST(VladColumns, OfTwoDescriptors) {
  // One beside the other, a column each, one word at (0, 0): residuals (4, -9) and (0, 0).
  const VladGrid grid{.down = 1, .across = 2, .margin_y = 0, .margin_x = 0, .rows = 1, .columns = 2};
  const FloatRows out =
      vlad_columns({.width = 2, .values = {4, -9, 0, 0}}, {.width = 2, .values = {0, 0}}, grid);
  ASSERT_EQ(out.size(), 2U);
  // Divided by its length sqrt(97), signed roots 2 and -3 over 97^(1/4), and again divided by the length.
  EXPECT_NEAR(out[0][0], 2 / std::sqrt(13.0), 1e-6);
  EXPECT_NEAR(out[0][1], -3 / std::sqrt(13.0), 1e-6);
  EXPECT_THAT(out[1], testing::Each(0.0F));
}

TEST(VladColumns, FollowTheDefinition) {
  const VladGrid grid{.down = 5, .across = 7, .margin_y = 1.5, .margin_x = 2.5, .rows = 2, .columns = 3};
  const FloatRows descriptors = random_rows(4, 35, 1), words = random_rows(4, 3, 2);
  const FloatRows out = vlad_columns(descriptors, words, grid);
  ASSERT_EQ(out.width, 2U * 3U * 4U);
  const auto share = [](int i, int positions, double margin, int part, int parts) {
    const double at = (i + 0.5 + margin) / (positions + 2 * margin) * parts - 0.5;
    return std::max(0.0, 1 - std::abs(std::clamp(at, 0.0, parts - 1.0) - part));
  };
  for (int column = 0; column < 3; ++column) {
    std::vector<double> expected;
    for (int row = 0; row < 2; ++row) {
      for (std::size_t word = 0; word < 3; ++word) {
        const std::vector<std::size_t> nearest = place::nearest_words(descriptors, words);
        std::vector<double> sum(4);
        for (int i = 0; i < 35; ++i) {
          const auto descriptor = descriptors[static_cast<std::size_t>(i)];
          if (nearest[static_cast<std::size_t>(i)] != word) continue;
          const double weight = share(i / 7, 5, 1.5, row, 2) * share(i % 7, 7, 2.5, column, 3);
          for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * (descriptor[k] - words[word][k]);
        }
        const double length = std::sqrt(std::inner_product(sum.begin(), sum.end(), sum.begin(), 0.0));
        for (const double value : sum)
          expected.push_back(length > 0 ? std::copysign(std::sqrt(std::abs(value / length)), value) : 0);
      }
    }
    const double length =
        std::sqrt(std::inner_product(expected.begin(), expected.end(), expected.begin(), 0.0));
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(out[static_cast<std::size_t>(column)][k], expected[k] / length,
                  1e-4);  // roots of float sums
  }
}

TEST(VladColumns, OfAViewOneColumnFurtherAreTheSameColumns) {
  // Three positions to a column, no margin: moving the picture by three moves the columns by one.
  const VladGrid grid{.down = 2, .across = 12, .margin_y = 0, .margin_x = 0, .rows = 1, .columns = 4};
  const FloatRows wide = random_rows(3, 2 * 15, 5), words = random_rows(3, 4, 6);
  const auto view = [&](std::size_t left) {
    FloatRows out = make_float_rows(3, 24);
    for (std::size_t i = 0; i < 24; ++i) std::ranges::copy(wide[i / 12 * 15 + left + i % 12], out[i].begin());
    return vlad_columns(out, words, grid);
  };
  const FloatRows here = view(0), there = view(3);
  // The outer columns also take what lies beyond their middles, so only inner ones are the same.
  for (std::size_t k = 0; k < here.width; ++k) EXPECT_NEAR(here[2][k], there[1][k], 1e-5);
}

TEST(VladColumns, OfWordsThemselvesAreNothing) {
  const FloatRows words{.width = 2, .values = {1, 2}};
  const VladGrid grid{.down = 1, .across = 3, .margin_y = 0, .margin_x = 0, .rows = 1, .columns = 2};
  EXPECT_THAT(vlad_columns({.width = 2, .values = {1, 2, 1, 2, 1, 2}}, words, grid).values,
              testing::Each(0.0F));
}

TEST(VladColumns, RefuseSizesThatDiffer) {
  const FloatRows words{.width = 2, .values = {1, 2}};
  EXPECT_THROW(vlad_columns({.width = 2, .values = {1, 2}}, words), std::invalid_argument);
  const VladGrid one{.down = 1, .across = 1, .margin_y = 0, .margin_x = 0, .rows = 1, .columns = 1};
  EXPECT_THROW(vlad_columns({.width = 3, .values = {1, 2, 3}}, words, one), std::invalid_argument);
  EXPECT_THROW(vlad_columns({.width = 2, .values = {1, 2}}, {.width = 2, .values = {}}, one),
               std::invalid_argument);
}

}  // namespace
