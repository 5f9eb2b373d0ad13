#include "overview.hpp"

#include <algorithm>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace retrace {
namespace {

constexpr int kMargin_px = 18;
constexpr int kTitle_px = 26;
constexpr int kGreyLevels = 32;  // finer noise makes a much larger file and looks the same

const cv::Scalar kPaper(255, 255, 255), kInk(60, 50, 45);

void write(cv::Mat& page, const std::string& text, cv::Point at, double size = 0.5) {
  cv::putText(page, text, at, cv::FONT_HERSHEY_SIMPLEX, size, kInk, 1, cv::LINE_AA);
}

cv::Mat fitted(const cv::Mat& view) {
  cv::Mat small;
  cv::resize(view, small, {kOverviewTile_px, kOverviewTile_px * view.rows / view.cols}, 0, 0, cv::INTER_AREA);
  cv::Mat levels(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i) {
    levels.at<std::uint8_t>(i) = static_cast<std::uint8_t>((i * kGreyLevels / 256) * 255 / (kGreyLevels - 1));
  }
  cv::LUT(small, levels, small);
  return small;
}

// Places tiles side by side below `top`, each under its title; returns their lower end.
int put_row(cv::Mat& page, const std::vector<OverviewTile>& tiles, int top) {
  int bottom = top, left = kMargin_px;
  for (const OverviewTile& tile : tiles) {
    write(page, tile.title, {left, top + kTitle_px - 9});
    const cv::Rect place({left, top + kTitle_px}, tile.picture.size());
    tile.picture.copyTo(page(place));
    bottom = std::max(bottom, place.br().y);
    left += kOverviewTile_px + kMargin_px;
  }
  return bottom;
}

}  // namespace

std::vector<std::uint8_t> overview_picture(const std::vector<OverviewTile>& views,
                                           const std::vector<OverviewTile>& matrices) {
  constexpr int kRoom_px = kOverviewTile_px + kMargin_px + kTitle_px;  // for a tile, more than any needs
  cv::Mat page(2 * kRoom_px + kTitle_px, 2 * kOverviewTile_px + 3 * kMargin_px, CV_8UC3, kPaper);
  std::vector<OverviewTile> small;
  for (const OverviewTile& view : views) small.push_back({fitted(view.picture), view.title});
  int bottom = put_row(page, small, kMargin_px / 2);
  bottom = put_row(page, matrices, bottom + kMargin_px / 2);
  write(page,
        "Across: where on the night walk. Up: where on the day walk. Dark: alike. Orange: found. Blue: best, "
        "unsure.",
        {kMargin_px, bottom + kTitle_px - 6}, 0.45);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", page.rowRange(0, bottom + kTitle_px + 4), png, {cv::IMWRITE_PNG_COMPRESSION, 9});
  return png;
}

}  // namespace retrace
