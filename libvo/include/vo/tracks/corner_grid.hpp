#pragma once

#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Settings of `grid_corners`.
struct CornerGridOptions {
  int columns = 20;            ///< square cells across the picture; each holds one corner
  int block_px = 5;            ///< neighbourhood that a corner is detected in, odd
  double min_response = 2e-4;  ///< least eigenvalue, of gradients in grey ranges per pixel
  double min_relative = 0.01;  ///< share of the strongest response in the picture
};

/// Corners to track, spread over the picture: the strongest (Shi and Tomasi, "Good features to track", 1994)
/// in each cell without any of `existing`, at least half a cell from those and each other. `grey`: 8 bit, one
/// channel. Throws `std::invalid_argument` for other pictures or options out of range. O(pixels).
std::vector<cv::Point2f> grid_corners(const cv::Mat& grey, std::span<const cv::Point2f> existing,
                                      const CornerGridOptions& options = {});

}  // namespace vo
