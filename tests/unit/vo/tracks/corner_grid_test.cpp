#include "support/blob_scene.hpp"

#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vo/tracks/corner_grid.hpp>

namespace {

TEST(CornerGrid, FindsTheCornersOfASquare) {
  cv::Mat1b picture(160, 160, uchar{60});
  cv::rectangle(picture, {40, 40, 60, 60}, cv::Scalar(200), cv::FILLED);  // pixels 40..99
  const auto corners = vo::grid_corners(picture, {}, {.columns = 4});
  ASSERT_EQ(corners.size(), 4U);
  for (const cv::Point2f& corner : corners) {
    const auto off = [](float x) { return std::min(std::abs(x - 39.5F), std::abs(x - 99.5F)); };
    EXPECT_LE(off(corner.x), 3) << corner;  // within the neighbourhood of 5 pixels
    EXPECT_LE(off(corner.y), 3) << corner;
  }
}

TEST(CornerGrid, IsSpreadOverThePicture) {
  const cv::Mat picture = test_support::noise_picture({320, 200}, 1);
  const auto corners = vo::grid_corners(picture, {}, {.columns = 10});  // cells of 32 pixels, 7 rows
  std::set<std::pair<int, int>> cells;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_TRUE(
        cells.emplace(static_cast<int>(corners[i].x / 32), static_cast<int>(corners[i].y / 32)).second);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(cv::norm(corners[i] - corners[j]), 16);
  }
  EXPECT_GT(corners.size(), 40U);  // of 70 cells; neighbours' corners keep each other at half a cell
}

TEST(CornerGrid, LeavesCellsThatHaveOneAlone) {
  const cv::Mat picture = test_support::noise_picture({320, 200}, 1);
  std::vector<cv::Point2f> existing;
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 10; ++column) {
      if (row != 3 || column != 4)
        existing.emplace_back(32 * column + 16.0F, std::min(199.0F, 32 * row + 16.0F));
    }
  }
  const auto corners = vo::grid_corners(picture, existing, {.columns = 10});
  ASSERT_LE(corners.size(), 1U);
  for (const cv::Point2f& corner : corners) {
    EXPECT_EQ(static_cast<int>(corner.x / 32), 4);
    EXPECT_EQ(static_cast<int>(corner.y / 32), 3);
  }
}

TEST(CornerGrid, SeesNothingWhereThereIsNothing) {
  EXPECT_TRUE(vo::grid_corners(cv::Mat1b(100, 100, uchar{128}), {}).empty());
  cv::Mat1b edge(100, 100, uchar{50});
  edge.colRange(50, 100).setTo(200);
  EXPECT_TRUE(vo::grid_corners(edge.rowRange(10, 90), {}).empty());  // an edge is no corner
  EXPECT_EQ(vo::grid_corners(cv::Mat1b(1, 1, uchar{128}), {}).size(), 0U);
}

TEST(CornerGrid, RefusesWhatDoesNotFit) {
  EXPECT_THROW(vo::grid_corners(cv::Mat(), {}), std::invalid_argument);
  EXPECT_THROW(vo::grid_corners(cv::Mat(9, 9, CV_8UC3), {}), std::invalid_argument);
  EXPECT_THROW(vo::grid_corners(cv::Mat1b(9, 9, uchar{0}), {}, {.columns = 0}), std::invalid_argument);
}

}  // namespace
