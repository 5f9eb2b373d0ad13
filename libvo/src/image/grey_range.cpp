#include "vo/image/grey_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace vo {

std::optional<GreyRange> range_of(std::span<const cv::Mat> pictures) {
  std::vector<float> values;
  for (const cv::Mat& picture : pictures) {
    cv::Mat flat;
    picture.reshape(1).convertTo(flat, CV_32F);
    std::copy_if(flat.begin<float>(), flat.end<float>(), std::back_inserter(values),
                 [](float value) { return std::isfinite(value); });
  }
  if (values.empty()) return std::nullopt;
  constexpr double kOutside = 0.001;
  const auto skip = static_cast<std::ptrdiff_t>(kOutside * static_cast<double>(values.size()));
  const auto low = values.begin() + skip, high = values.end() - 1 - skip;
  std::nth_element(values.begin(), low, values.end());
  const float black = *low;
  std::nth_element(values.begin(), high, values.end());
  if (!(*high > black)) return std::nullopt;
  return GreyRange{.black = black, .white = *high};
}

cv::Mat thinned(const cv::Mat& picture) {
  constexpr double kMost_px = 1e6;
  const double scale = std::sqrt(kMost_px / static_cast<double>(picture.total()));
  if (scale >= 1) return picture.clone();
  cv::Mat thin;
  cv::resize(picture, thin, {}, scale, scale, cv::INTER_NEAREST);
  return thin;
}

cv::Mat stretched(const cv::Mat& picture, const GreyRange& range) {
  const double scale = 255 / (range.white - range.black);
  cv::Mat image;
  picture.convertTo(image, CV_8U, scale, -range.black * scale);
  return image;
}

}  // namespace vo
