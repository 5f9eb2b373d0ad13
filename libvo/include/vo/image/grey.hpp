#pragma once

#include <opencv2/core/mat.hpp>

namespace vo {

/// The grey picture of a frame of 8 bits, grey or BGR, resized to `width_px` columns if it is wider. Shares
/// the frame's pixels where nothing changes. O(pixels).
cv::Mat grey_of(const cv::Mat& frame, int width_px);

}  // namespace vo
