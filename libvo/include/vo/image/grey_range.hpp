#pragma once

#include <optional>
#include <span>

#include <opencv2/core/mat.hpp>

namespace vo {

/// The values of a deep picture (more than 8 bits) that become black and white.
struct GreyRange {
  double black = 0;
  double white = 65535;
};

/// The range that pictures of a walk use: from the 0.1th to the 99.9th percentile of all their values
/// together, so that a hot or dead pixel does not stretch it. Thermal and depth cameras use a few hundred of
/// 65536 values, of which the upper 8 bits would keep almost nothing. None for no pictures, or pictures of
/// one value. NaN are skipped. O(pixels).
std::optional<GreyRange> range_of(std::span<const cv::Mat> pictures);

/// At most a million of a picture's pixels, evenly spread: enough for `range_of`, whatever the camera.
cv::Mat thinned(const cv::Mat& picture);

/// The picture in 8 bits, `black` and below 0, `white` and above 255, linear between; of any depth and
/// channels.
cv::Mat stretched(const cv::Mat& picture, const GreyRange& range);

}  // namespace vo
