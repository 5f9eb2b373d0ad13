#include "vo/image/black_bars.hpp"

#include <algorithm>
#include <vector>

#include <opencv2/core.hpp>

namespace vo {
namespace {

constexpr double kLeastShare = 0.02;  // of the height or width: what encoders round to is less
constexpr int kBlack = 12;            // grey levels: black with the noise of compression
constexpr int kLit = 24;              // and surely not black

int least_px(int length) {
  return std::max(2, static_cast<int>(kLeastShare * length));
}

/// Rows from the top of the brightest values that are black.
int black_rows(const cv::Mat& brightest) {
  for (int row = 0; row < brightest.rows; ++row) {
    double most = 0;
    cv::minMaxLoc(brightest.row(row), nullptr, &most);
    if (most > kBlack) return row;
  }
  return brightest.rows;
}

cv::Mat upside_down(const cv::Mat& picture) {
  cv::Mat turned;
  cv::flip(picture, turned, 0);
  return turned;
}

/// What the rows from the top show: how many are black in all pictures, and where the bar ends that they may
/// be.
struct Rim {
  int black = 0;
  int bar = 0;  ///< 0: no straight edge ends them
};

Rim rim_above(const std::vector<cv::Mat>& pictures) {
  cv::Mat brightest = pictures[0].clone();
  for (const cv::Mat& picture : pictures) cv::max(brightest, picture, brightest);
  Rim rim{.black = black_rows(brightest)};
  constexpr double kMost = 0.4;  // an upright picture in a wide one has bars of a third
  if (rim.black < least_px(brightest.rows) || rim.black > kMost * brightest.rows) return rim;
  // The edge itself may be blurred by compression and scaling; the first row that is lit is the scene's.
  constexpr int kBlurred = 8;
  constexpr double kShareLit = 0.5, kShareOfPictures = 0.25;
  for (int row = rim.black; row < std::min(rim.black + kBlurred, brightest.rows); ++row) {
    const auto lit = std::ranges::count_if(pictures, [&](const cv::Mat& picture) {
      return cv::countNonZero(picture.row(row) > kLit) >= kShareLit * picture.cols;
    });
    if (static_cast<double>(lit) >= kShareOfPictures * static_cast<double>(pictures.size())) {
      rim.bar = row;
      break;
    }
  }
  return rim;
}

/// The bars above and below.
struct Bars {
  int above = 0, below = 0;
};

Bars bars_of(const std::vector<cv::Mat>& pictures) {
  std::vector<cv::Mat> turned;
  for (const cv::Mat& picture : pictures) turned.push_back(upside_down(picture));
  const Rim top = rim_above(pictures), bottom = rim_above(turned);
  Bars bars{top.bar, bottom.bar};
  if (bars.above == 0 && top.black >= bars.below) bars.above = bars.below;
  if (bars.below == 0 && bottom.black >= bars.above) bars.below = bars.above;
  constexpr double kMostOneSided = 0.25;
  const bool one_sided = bars.above == 0 || bars.below == 0;
  if (one_sided && std::max(bars.above, bars.below) > kMostOneSided * pictures[0].rows) return {};
  return bars;
}

}  // namespace

bool may_have_black_bars(const cv::Mat& grey) {
  const cv::Mat sideways = grey.t();
  return black_rows(grey) >= least_px(grey.rows) || black_rows(upside_down(grey)) >= least_px(grey.rows) ||
         black_rows(sideways) >= least_px(grey.cols) ||
         black_rows(upside_down(sideways)) >= least_px(grey.cols);
}

std::optional<cv::Rect> find_black_bars(std::span<const cv::Mat> pictures) {
  std::vector<cv::Mat> shown;
  for (const cv::Mat& picture : pictures) {
    if (cv::countNonZero(picture > kLit) > 0) shown.push_back(picture);
  }
  if (shown.empty()) return std::nullopt;
  const cv::Size size = shown[0].size();
  // Above and below first: those bars would count as unlit in the columns beside the picture.
  const Bars upright = bars_of(shown);
  for (cv::Mat& picture : shown) picture = picture.rowRange(upright.above, size.height - upright.below).t();
  const Bars beside = bars_of(shown);
  if (upright.above + upright.below + beside.above + beside.below == 0) return std::nullopt;
  return cv::Rect(beside.above, upright.above, size.width - beside.above - beside.below,
                  size.height - upright.above - upright.below);
}

}  // namespace vo
