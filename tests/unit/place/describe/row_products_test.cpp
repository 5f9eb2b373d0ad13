#include "place/describe/row_products.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <vo/base/parallel.hpp>
#include <vo/base/rng.hpp>

namespace {

using place::FloatRows;
using place::make_float_rows;
using place::RowPanels;

FloatRows drawn(std::size_t width, std::size_t count, std::uint64_t seed) {
  vo::Rng rng(seed);
  FloatRows rows = make_float_rows(width, count);
  for (float& value : rows.values) value = static_cast<float>(rng.normal());
  return rows;
}

FloatRows transposed(const FloatRows& matrix) {
  FloatRows rows = make_float_rows(matrix.size(), matrix.width);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows.width; ++k) rows[i][k] = matrix[k][i];
  return rows;
}

void expect_products(const FloatRows& products, const FloatRows& left, const FloatRows& right) {
  ASSERT_EQ(products.size(), left.size());
  ASSERT_EQ(products.width, right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < right.size(); ++j) {
      const double exact = std::inner_product(left[i].begin(), left[i].end(), right[j].begin(), 0.0);
      ASSERT_NEAR(products[i][j], exact, 1e-3 + 5e-6 * std::abs(exact)) << i << ", " << j;
    }
  }
}

// Fewer and more rows than a tile and a panel have, and lengths on both sides of a stretch.
TEST(RowProducts, EqualTheSumsOfProducts) {
  for (const std::size_t width : {1UL, 5UL, 1024UL, 1025UL, 2500UL}) {
    for (const std::size_t count : {1UL, 31UL, 33UL, 110UL}) {
      const FloatRows left = drawn(width, count, 1), right = drawn(width, 67, 2);
      expect_products(RowPanels(right).products(left), left, right);
      expect_products(RowPanels::of_columns(transposed(right)).products(left), left, right);
    }
  }
}

TEST(RowProducts, OfAllPairsAreSymmetric) {
  const FloatRows rows = drawn(1100, 131, 3);
  expect_products(place::products_of_rows(rows), rows, rows);
  EXPECT_EQ(place::products_of_columns(transposed(rows)).values, place::products_of_rows(rows).values);
}

TEST(RowProducts, AreTheSameForAnyNumberOfThreads) {
  const FloatRows left = drawn(1500, 300, 4), right = drawn(1500, 90, 5);
  vo::set_thread_count(1);
  const FloatRows one = RowPanels(right).products(left);
  vo::set_thread_count(4);
  const FloatRows four = RowPanels(right).products(left);
  vo::set_thread_count(0);
  EXPECT_EQ(one.values, four.values);
}

TEST(RowProducts, OfNothingAreNothing) {
  EXPECT_TRUE(RowPanels(drawn(3, 2, 1)).products(make_float_rows(3, 0)).values.empty());
  EXPECT_EQ(place::products_of_rows({}).size(), 0U);
}

TEST(RowProducts, OfOtherLengthsAreRefused) {
  EXPECT_THROW((void)RowPanels(drawn(3, 2, 1)).products(drawn(4, 2, 1)), std::invalid_argument);
}

}  // namespace
