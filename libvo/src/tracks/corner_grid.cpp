#include "vo/tracks/corner_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

struct Corner {
  float response = 0;
  cv::Point2f at;
};

/// Points by cell, so that only neighbours need a distance test.
class CellIndex {
 public:
  CellIndex(cv::Size picture, int columns)
      : cell_px_(static_cast<float>(picture.width) / static_cast<float>(columns)),
        columns_(columns),
        rows_(static_cast<int>(std::ceil(static_cast<float>(picture.height) / cell_px_))),
        points_(static_cast<std::size_t>(columns_ * rows_)) {}

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] bool empty(int column, int row) const { return cell(column, row).empty(); }
  /// The pixels of a cell.
  [[nodiscard]] cv::Rect pixels(int column, int row, cv::Size picture) const {
    const auto edge = [&](int i) { return static_cast<int>(std::lround(static_cast<float>(i) * cell_px_)); };
    const cv::Rect whole(edge(column), edge(row), edge(column + 1) - edge(column), edge(row + 1) - edge(row));
    return whole & cv::Rect({}, picture);
  }
  void add(cv::Point2f point) { points_[index(column_of(point), row_of(point))].push_back(point); }
  [[nodiscard]] bool near_one(cv::Point2f point, float distance_px) const {
    const int column = column_of(point), row = row_of(point);
    for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c) {
        for (const cv::Point2f other : cell(c, r)) {
          if (std::hypot(other.x - point.x, other.y - point.y) < distance_px) return true;
        }
      }
    }
    return false;
  }
  [[nodiscard]] float cell_px() const { return cell_px_; }

 private:
  [[nodiscard]] int column_of(cv::Point2f p) const {
    return std::clamp(static_cast<int>(p.x / cell_px_), 0, columns_ - 1);
  }
  [[nodiscard]] int row_of(cv::Point2f p) const {
    return std::clamp(static_cast<int>(p.y / cell_px_), 0, rows_ - 1);
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  [[nodiscard]] const std::vector<cv::Point2f>& cell(int column, int row) const {
    return points_[index(column, row)];
  }

  float cell_px_;
  int columns_, rows_;
  std::vector<std::vector<cv::Point2f>> points_;
};

}  // namespace

std::vector<cv::Point2f> grid_corners(const cv::Mat& grey, std::span<const cv::Point2f> existing,
                                      const CornerGridOptions& options) {
  if (grey.empty() || grey.type() != CV_8UC1)
    throw std::invalid_argument("grid_corners: a grey picture of 8 bits expected");
  if (options.columns < 1 || options.block_px < 1)
    throw std::invalid_argument("grid_corners: columns and block_px must be >= 1");
  CellIndex cells(grey.size(), std::min(options.columns, grey.cols));
  for (const cv::Point2f point : existing) cells.add(point);

  cv::Mat1f response;
  cv::cornerMinEigenVal(grey, response, options.block_px, 3);
  double strongest = 0;
  cv::minMaxLoc(response, nullptr, &strongest);
  const auto least = static_cast<float>(std::max(options.min_response, options.min_relative * strongest));

  std::vector<Corner> found;
  for (int row = 0; row < cells.rows(); ++row) {
    for (int column = 0; column < cells.columns(); ++column) {
      const cv::Rect area = cells.pixels(column, row, grey.size());
      if (area.empty() || !cells.empty(column, row)) continue;
      double value = 0;
      cv::Point place;
      cv::minMaxLoc(response(area), nullptr, &value, nullptr, &place);
      if (value >= least) found.push_back({static_cast<float>(value), cv::Point2f(place + area.tl())});
    }
  }
  std::ranges::stable_sort(found, std::greater{}, &Corner::response);
  std::vector<cv::Point2f> corners;
  for (const Corner& corner : found) {
    if (cells.near_one(corner.at, cells.cell_px() / 2)) continue;
    cells.add(corner.at);
    corners.push_back(corner.at);
  }
  return corners;
}

}  // namespace vo
