#include "heat_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace retrace {
namespace {

constexpr int kCellWidth_px = 64, kCellHeight_px = 34, kLabel_px = 74, kHeatMargin_px = 20,
              kHeatTitle_px = 58;
const cv::Scalar kHeatPaper(255, 255, 255), kHeatInk(50, 40, 35), kLight(246, 240, 230), kDark(120, 60, 15);

void label(cv::Mat& page, const std::string& text, cv::Point at, const cv::Scalar& colour = kHeatInk) {
  cv::putText(page, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.42, colour, 1, cv::LINE_AA);
}

void draw(cv::Mat& page, const HeatTable& table, cv::Point corner, double low, double high) {
  label(page, table.title, {corner.x, corner.y + 14});
  label(page, table.column_title, {corner.x + kLabel_px, corner.y + 33});
  label(page, table.row_title.substr(0, 9), {corner.x, corner.y + kHeatTitle_px - 5});
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    label(page, table.columns[c],
          {corner.x + kLabel_px + static_cast<int>(c) * kCellWidth_px + 8, corner.y + kHeatTitle_px - 5});
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const int y = corner.y + kHeatTitle_px + static_cast<int>(r) * kCellHeight_px;
    label(page, table.rows[r], {corner.x, y + 22});
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const double value = table.values[r][c];
      if (std::isnan(value)) continue;
      const double shade = high > low ? (value - low) / (high - low) : 1;
      const cv::Rect cell(corner.x + kLabel_px + static_cast<int>(c) * kCellWidth_px, y, kCellWidth_px - 2,
                          kCellHeight_px - 2);
      cv::rectangle(page, cell, kLight * (1 - shade) + kDark * shade, cv::FILLED);
      label(page, fmt::format("{:.3f}", value), {cell.x + 9, y + 21}, shade > 0.5 ? kHeatPaper : kHeatInk);
    }
  }
}

}  // namespace

std::vector<std::uint8_t> heat_picture(const std::vector<HeatTable>& tables) {
  const auto [low, high] = value_range(tables);
  int width = kHeatMargin_px, height = 0;
  for (const HeatTable& table : tables) {
    width += std::max(kLabel_px + static_cast<int>(table.columns.size()) * kCellWidth_px,
                      static_cast<int>(table.title.size()) * 8) +
             kHeatMargin_px;
    height = std::max(height, kHeatTitle_px + static_cast<int>(table.rows.size()) * kCellHeight_px);
  }
  cv::Mat page(height + 2 * kHeatMargin_px, width, CV_8UC3, kHeatPaper);
  int left = kHeatMargin_px;
  for (const HeatTable& table : tables) {
    draw(page, table, {left, kHeatMargin_px}, low, high);
    left += std::max(kLabel_px + static_cast<int>(table.columns.size()) * kCellWidth_px,
                     static_cast<int>(table.title.size()) * 8) +
            kHeatMargin_px;
  }
  std::vector<std::uint8_t> png;
  cv::imencode(".png", page, png);
  return png;
}

}  // namespace retrace
