#include "vo/image/picture_quality.hpp"

#include <algorithm>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

constexpr int kWidth_px = 640;  // of all recordings, so that their blur compares
constexpr int kSmooth_px = 9;   // Crete et al.'s filter

/// Differences between neighbours in a row, without sign.
cv::Mat differences(const cv::Mat& picture) {
  cv::Mat result;
  cv::absdiff(picture.colRange(1, picture.cols), picture.colRange(0, picture.cols - 1), result);
  return result;
}

/// The share of the differences along rows that stays; none without any.
std::optional<double> blur_along_rows(const cv::Mat& picture) {
  if (picture.cols < 2) return std::nullopt;
  cv::Mat smooth;
  cv::blur(picture, smooth, {kSmooth_px, 1});
  const cv::Mat before = differences(picture), after = differences(smooth);
  const double all = cv::sum(before)[0];
  if (all <= 0) return std::nullopt;
  cv::Mat lost;  // where smoothing lowered the difference, by how much
  cv::subtract(before, after, lost);
  cv::max(lost, 0, lost);
  return (all - cv::sum(lost)[0]) / all;
}

}  // namespace

PictureQuality picture_quality(const cv::Mat& grey) {
  if (grey.empty() || grey.type() != CV_8UC1)
    throw std::invalid_argument("picture_quality: a grey picture of 8 bits expected");
  cv::Mat small = grey;
  if (grey.cols > kWidth_px) {
    const double scale = static_cast<double>(kWidth_px) / grey.cols;
    cv::resize(grey, small, {kWidth_px, std::max(1, cvRound(grey.rows * scale))}, 0, 0, cv::INTER_AREA);
  }
  PictureQuality quality{.level = cv::mean(small)[0], .blur = {}};
  cv::Mat rows, columns;
  small.convertTo(rows, CV_32F);
  columns = rows.t();
  const std::optional<double> along_rows = blur_along_rows(rows), along_columns = blur_along_rows(columns);
  if (along_rows || along_columns) quality.blur = std::max(along_rows.value_or(0), along_columns.value_or(0));
  return quality;
}

}  // namespace vo
