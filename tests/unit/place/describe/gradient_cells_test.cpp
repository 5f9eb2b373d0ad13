#include "place/describe/gradient_cells.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <vo/base/rng.hpp>

namespace {

using place::CellGrid;
using place::gradient_cells;

cv::Mat random_picture(int width, int height, std::uint64_t seed) {
  vo::Rng rng(seed);
  cv::Mat picture(height, width, CV_8U);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(rng.index(256));
  return picture;
}

/// The definition, pixel by pixel, in double: every pixel looks at every cell and every direction.
std::vector<double> by_definition(const cv::Mat& picture, const CellGrid& grid) {
  std::vector<double> cells(grid.values());
  const auto at = [&](int y, int x) {
    return static_cast<double>(
        picture.at<std::uint8_t>(std::clamp(y, 0, picture.rows - 1), std::clamp(x, 0, picture.cols - 1)));
  };
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double dx = at(y, x + 1) - at(y, x - 1), dy = at(y + 1, x) - at(y - 1, x);
      const double angle = std::atan2(dy, dx);
      for (int k = 0; k < grid.directions; ++k) {
        const double middle = 2 * std::numbers::pi * (k + 0.5) / grid.directions;
        const double apart = std::abs(std::remainder(angle - middle, 2 * std::numbers::pi));
        const double of_direction = std::max(0.0, 1 - apart * grid.directions / (2 * std::numbers::pi));
        for (int r = 0; r < grid.rows; ++r) {
          for (int c = 0; c < grid.columns; ++c) {
            const auto of_side = [&](int pixel, int cell) {
              return std::max(0.0, 1 - std::abs((pixel + 0.5) / grid.cell_px - (cell + 0.5)));
            };
            cells[static_cast<std::size_t>((r * grid.columns + c) * grid.directions + k)] +=
                std::hypot(dx, dy) * of_direction * of_side(y, r) * of_side(x, c);
          }
        }
      }
    }
  }
  return cells;
}

TEST(GradientCells, FollowTheDefinition) {
  const CellGrid grid{.rows = 3, .columns = 5, .cell_px = 4, .directions = 8};
  const cv::Mat picture = random_picture(20, 12, 7);
  const std::vector<float> cells = gradient_cells(picture, grid);
  const std::vector<double> expected = by_definition(picture, grid);
  ASSERT_EQ(cells.size(), expected.size());
  // The polynomial arctangent is right to 1e-5 of a turn, 8e-5 of a direction's width; a cell sums 64 pixels
  // of up to 361 with weights of 16 in all.
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_NEAR(cells[i], expected[i], 0.5) << i;
}

TEST(GradientCells, OfAnEdgeLieInItsDirection) {
  // Dark left, light right of the middle: dx > 0, dy = 0, between directions 0 and 7, half each.
  cv::Mat picture(8, 16, CV_8U, cv::Scalar(10));
  picture.colRange(8, 16).setTo(110);
  const CellGrid grid{.rows = 2, .columns = 4, .cell_px = 4, .directions = 8};
  const std::vector<float> cells = gradient_cells(picture, grid);
  // Two columns of pixels, 7 and 8, of magnitude 100; each cell takes of a column (0.5 / 4 + 0.5) = 0.625
  // from the nearer side, 0.375 from the farther: 1 in all; of the rows 3.5 (the outer half reaches outside).
  const double whole = 100 * 3.5;
  const auto value = [&](int row, int column, int k) {
    return cells[static_cast<std::size_t>((row * grid.columns + column) * grid.directions + k)];
  };
  for (const int row : {0, 1}) {
    for (const int column : {1, 2}) {
      EXPECT_NEAR(value(row, column, 0), whole / 2, 0.01);
      EXPECT_NEAR(value(row, column, 7), whole / 2, 0.01);
      EXPECT_NEAR(value(row, column, 3), 0, 1e-4);
    }
    EXPECT_EQ(value(row, 0, 0), 0);
    EXPECT_EQ(value(row, 3, 0), 0);
  }
}

TEST(GradientCells, OfOneGreyAreNothing) {
  const std::vector<float> cells = gradient_cells(cv::Mat(90, 160, CV_8UC3, cv::Scalar(7, 80, 200)));
  EXPECT_EQ(cells.size(), CellGrid{}.values());
  EXPECT_THAT(cells, testing::Each(0.0F));
}

TEST(GradientCells, OfAPictureOfOnePixelAreNothing) {
  EXPECT_THAT(gradient_cells(cv::Mat(1, 1, CV_8U, cv::Scalar(9))), testing::Each(0.0F));
}

TEST(GradientCells, RefuseWhatIsNoPicture) {
  EXPECT_THROW(gradient_cells(cv::Mat()), std::invalid_argument);
  EXPECT_THROW(gradient_cells(cv::Mat(8, 8, CV_32F, cv::Scalar(0))), std::invalid_argument);
  EXPECT_THROW(gradient_cells(random_picture(8, 8, 1), {.rows = 0}), std::invalid_argument);
}

TEST(PackedCells, KeepWhatTheyHold) {
  std::vector<float> cells(1000);
  std::iota(cells.begin(), cells.end(), 0.0F);
  const std::vector<float> back = place::unpack_cells(place::pack_cells(cells));
  // Half a step of sqrt(999) / 255 in the square root: sqrt(v) * 0.124 + 0.004, and rounding.
  for (std::size_t i = 0; i < cells.size(); ++i)
    EXPECT_NEAR(back[i], cells[i], 0.124 * std::sqrt(cells[i]) + 0.01) << i;
  EXPECT_FLOAT_EQ(back.back(), cells.back());
}

TEST(PackedCells, OfNothingAreNothing) {
  EXPECT_THAT(place::unpack_cells(place::pack_cells(std::vector<float>(5))), testing::Each(0.0F));
  EXPECT_TRUE(place::unpack_cells(place::pack_cells({})).empty());
  EXPECT_THROW(place::unpack_cells(std::vector<std::uint8_t>(3)), std::invalid_argument);
}

}  // namespace
