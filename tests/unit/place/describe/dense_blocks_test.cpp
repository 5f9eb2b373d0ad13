#include "place/describe/dense_blocks.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vo/base/rng.hpp>

namespace {

using place::CellGrid;
using place::dense_blocks;
using place::FloatRows;

std::vector<float> random_cells(const CellGrid& grid, std::uint64_t seed) {
  vo::Rng rng(seed);
  std::vector<float> cells(grid.values());
  for (float& value : cells) value = static_cast<float>(rng.uniform(0, 300));
  return cells;
}

/// The same in double, one step of the definition after the other.
std::vector<double> by_definition(const std::vector<float>& cells, const CellGrid& grid, int top, int left) {
  std::vector<double> block;
  for (int v = 0; v < 6; ++v)
    for (int u = 0; u < 6; ++u)
      for (int k = 0; k < grid.directions; ++k)
        block.push_back(
            std::exp(-((u - 2.5) * (u - 2.5) + (v - 2.5) * (v - 2.5)) / 18) *
            cells[static_cast<std::size_t>(((top + v) * grid.columns + left + u) * grid.directions + k)]);
  const auto squares = [&] { return std::inner_product(block.begin(), block.end(), block.begin(), 0.0); };
  const double first = std::sqrt(squares() + 100);
  for (double& value : block) value = std::min(value / first, 0.2);
  const double second = std::sqrt(squares() + 1e-4);
  for (double& value : block) value /= second;
  const double sum = std::accumulate(block.begin(), block.end(), 1e-3);
  for (double& value : block) value = std::sqrt(value / sum);
  return block;
}

TEST(DenseBlocks, FollowTheDefinition) {
  const CellGrid grid{.rows = 7, .columns = 9, .cell_px = 4, .directions = 3};
  std::vector<float> cells = random_cells(grid, 3);
  cells[50] = 5000;  // one that is clipped
  const FloatRows blocks = dense_blocks(cells, grid);
  ASSERT_EQ(blocks.size(), 2U * 4U);
  ASSERT_EQ(blocks.width, 36U * 3U);
  for (int top = 0; top < 2; ++top) {
    for (int left = 0; left < 4; ++left) {
      const std::vector<double> expected = by_definition(cells, grid, top, left);
      const auto block = blocks[static_cast<std::size_t>(top * 4 + left)];
      // Sums of 108 floats are right to about 1e-6 of themselves, the values at most 0.5.
      for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(block[i], expected[i], 1e-5);
    }
  }
}

TEST(DenseBlocks, HaveLengthOne) {
  // The square root of what sums to 1; the floors take less than a hundredth where there is texture.
  const FloatRows blocks = dense_blocks(random_cells({}, 5));
  ASSERT_EQ(blocks.size(), 11U * 27U);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    EXPECT_NEAR(std::inner_product(blocks[i].begin(), blocks[i].end(), blocks[i].begin(), 0.0), 1, 0.01);
}

TEST(DenseBlocks, AreTheSameInAPictureOfTwiceTheContrast) {
  // But for the floor under the length: 100 beside 36 * 8 values of some 100^2.
  const std::vector<float> cells = random_cells({}, 6);
  std::vector<float> doubled = cells;
  for (float& value : doubled) value *= 2;
  const FloatRows once = dense_blocks(cells), twice = dense_blocks(doubled);
  for (std::size_t i = 0; i < once.values.size(); ++i) EXPECT_NEAR(once.values[i], twice.values[i], 1e-3);
}

TEST(DenseBlocks, OfNothingAreNothing) {
  EXPECT_THAT(dense_blocks(std::vector<float>(CellGrid{}.values())).values, testing::Each(0.0F));
}

TEST(DenseBlocks, RefuseCellsOfAnotherGrid) {
  EXPECT_THROW(dense_blocks(std::vector<float>(7)), std::invalid_argument);
  const CellGrid small{.rows = 5, .columns = 9, .cell_px = 4, .directions = 8};
  EXPECT_THROW(dense_blocks(std::vector<float>(small.values()), small), std::invalid_argument);
}

TEST(DenseBlocks, OfASmallestGridAreOne) {
  const CellGrid small{.rows = 6, .columns = 6, .cell_px = 4, .directions = 8};
  EXPECT_EQ(dense_blocks(random_cells(small, 1), small).size(), 1U);
}

}  // namespace
