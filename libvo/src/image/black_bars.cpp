#include "vo/image/black_bars.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <opencv2/core.hpp>

namespace vo {
namespace {

constexpr double kLeastShare = 0.02;  // of the height or width: what encoders round to is less
constexpr int kLit = 24;              // grey levels: surely not black

int least_px(int length) {
  return std::max(2, static_cast<int>(kLeastShare * length));
}

/// What a bar is filled with: black, or the dark grey that wrong video levels make of it.
struct Fill {
  int level = 0;  ///< grey levels
  int noise = 0;  ///< of compression, on either side of the level

  [[nodiscard]] int lit() const { return level + noise + kLit / 2; }  ///< surely not the fill
};

/// The fill that the outermost rows above have in all pictures; none if they are bright or show anything.
std::optional<Fill> fill_above(std::span<const cv::Mat> pictures) {
  constexpr int kBrightest = 48, kLeastNoise = 12, kMostNoise = 16;
  constexpr double kQuantile = 0.01, kBeyond = 1.5;  // of normal noise: one in 2000 is beyond that
  std::array<std::size_t, 256> count{};
  std::size_t all = 0;
  for (const cv::Mat& picture : pictures) {
    for (int row = 0; row < std::min(least_px(picture.rows), picture.rows); ++row) {
      for (int x = 0; x < picture.cols; ++x, ++all) ++count[picture.at<std::uint8_t>(row, x)];
    }
  }
  const auto level_at = [&](double share) {
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(all));
    std::size_t below = 0;
    for (int level = 0; level < 255; ++level) {
      below += count[static_cast<std::size_t>(level)];
      if (below > rank) return level;
    }
    return 255;
  };
  const int level = level_at(0.5);
  const int noise = std::max(level_at(1 - kQuantile) - level, level - level_at(kQuantile));
  if (level > kBrightest || noise > kMostNoise) return std::nullopt;
  return Fill{level, std::max(kLeastNoise, static_cast<int>(kBeyond * noise))};
}

/// Rows from the top that are filled in all pictures, but for a few pixels.
int filled_rows(std::span<const cv::Mat> pictures, const Fill& fill) {
  constexpr double kMostOther = 0.01;
  const int rows = pictures[0].rows, columns = pictures[0].cols;
  const auto most_other =
      static_cast<std::ptrdiff_t>(kMostOther * columns * static_cast<double>(pictures.size()));
  for (int row = 0; row < rows; ++row) {
    std::ptrdiff_t other = 0;
    for (const cv::Mat& picture : pictures) {
      const auto* values = picture.ptr<std::uint8_t>(row);
      other += std::count_if(values, values + columns,
                             [&](int value) { return std::abs(value - fill.level) > fill.noise; });
    }
    if (other > most_other) return row;
  }
  return rows;
}

cv::Mat upside_down(const cv::Mat& picture) {
  cv::Mat turned;
  cv::flip(picture, turned, 0);
  return turned;
}

/// What the rows from the top show: how many are filled in all pictures, and where the bar ends that they may
/// be.
struct Rim {
  int filled = 0;
  int bar = 0;  ///< 0: no straight edge ends them
};

Rim rim_above(std::span<const cv::Mat> pictures) {
  const std::optional<Fill> fill = fill_above(pictures);
  if (!fill) return {};
  const int rows = pictures[0].rows;
  Rim rim{.filled = filled_rows(pictures, *fill)};
  constexpr double kMost = 0.4;  // an upright picture in a wide one has bars of a third
  if (rim.filled < least_px(rows) || rim.filled > kMost * rows) return rim;
  // The edge itself may be blurred by compression and scaling; the first row that is lit is the scene's.
  constexpr int kBlurred = 8;
  constexpr double kShareLit = 0.5, kShareOfPictures = 0.25;
  for (int row = rim.filled; row < std::min(rim.filled + kBlurred, rows); ++row) {
    const auto lit = std::ranges::count_if(pictures, [&](const cv::Mat& picture) {
      return cv::countNonZero(picture.row(row) > fill->lit()) >= kShareLit * picture.cols;
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
  if (bars.above == 0 && top.filled >= bars.below) bars.above = bars.below;
  if (bars.below == 0 && bottom.filled >= bars.above) bars.below = bars.above;
  constexpr double kMostOneSided = 0.25;
  const bool one_sided = bars.above == 0 || bars.below == 0;
  if (one_sided && std::max(bars.above, bars.below) > kMostOneSided * pictures[0].rows) return {};
  return bars;
}

}  // namespace

bool may_have_black_bars(const cv::Mat& grey) {
  const auto above = [](const cv::Mat& picture) {
    const std::optional<Fill> fill = fill_above({&picture, 1});
    return fill && filled_rows({&picture, 1}, *fill) >= least_px(picture.rows);
  };
  const cv::Mat sideways = grey.t();
  return above(grey) || above(upside_down(grey)) || above(sideways) || above(upside_down(sideways));
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
