#include "vo/image/picture_mask.hpp"

#include <algorithm>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

namespace vo {
namespace {

cv::Size half(const cv::Size& size) {
  return {std::max(1, size.width / 2), std::max(1, size.height / 2)};
}

/// The weight for every channel of a picture.
cv::Mat for_channels(const cv::Mat& weight, int channels) {
  if (channels == 1) return weight;
  cv::Mat all;
  cv::merge(std::vector<cv::Mat>(static_cast<std::size_t>(channels), weight), all);
  return all;
}

}  // namespace

PictureMask::PictureMask(const cv::Mat& keep) {
  if (keep.empty() || keep.type() != CV_8UC1)
    throw std::invalid_argument("PictureMask: a grey picture expected");
  constexpr int kKept = 128;
  cv::Mat weight;
  cv::Mat(keep >= kKept).convertTo(weight, CV_32F, 1.0 / 255);
  if (cv::countNonZero(weight) == 0) throw std::invalid_argument("PictureMask: nothing is kept");
  weight_.push_back(weight);
  while (weight_.back().total() > 1) {
    cv::Mat smaller;
    cv::resize(weight_.back(), smaller, half(weight_.back().size()), 0, 0, cv::INTER_AREA);
    weight_.push_back(smaller);
  }
}

void PictureMask::fill(cv::Mat& picture) const {
  if (picture.size() != weight_[0].size() || picture.depth() != CV_8U)
    throw std::invalid_argument("PictureMask: a picture of 8 bits and the mask's size expected");
  // Push: what is kept, averaged with its weights, level by level.
  std::vector<cv::Mat> sum(weight_.size());
  picture.convertTo(sum[0], CV_32F);
  cv::multiply(sum[0], for_channels(weight_[0], picture.channels()), sum[0]);
  for (std::size_t level = 1; level < sum.size(); ++level)
    cv::resize(sum[level - 1], sum[level], weight_[level].size(), 0, 0, cv::INTER_AREA);
  // Pull: a pixel takes from the level above it what it has not got itself. `sum` is already weight x value.
  constexpr double kLeast = 1e-6;
  cv::Mat filled = sum.back() / std::max(kLeast, static_cast<double>(weight_.back().at<float>(0, 0)));
  for (std::size_t level = sum.size() - 1; level-- > 0;) {
    cv::Mat above;
    cv::resize(filled, above, sum[level].size(), 0, 0, cv::INTER_LINEAR);
    cv::multiply(above, for_channels(1 - weight_[level], picture.channels()), above);
    filled = sum[level] + above;
  }
  cv::Mat result;
  filled.convertTo(result, CV_8U);
  result.copyTo(picture, weight_[0] == 0);
}

}  // namespace vo
