#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// An image smoothed and perhaps shrunk, 16 steps per grey level.
struct SmoothLevel {
  int width = 0;    ///< pixels
  int height = 0;   ///< pixels
  int stride = 0;   ///< values from one row to the next
  int step_px = 1;  ///< pixel (x, y) lies at (x, y) * step_px of the image
  std::vector<std::uint16_t> values;
};

/// The image ever smoother, two levels per octave, to take gradients from: level 2o has a deviation of 0.58
/// to 0.71 pixels and level 2o + 1 of 1.15 to 1.23, of 2^o image pixels each. Each is the one before filtered
/// by a binomial, the even ones shrunk by half.
struct SmoothPyramid {
  std::vector<SmoothLevel> levels;

  /// The level for points of this scale, whose deviation is 0.25 to 0.55 of the scale, or the one `coarser`
  /// half octaves on. Scales below or above all levels give the first or last.
  [[nodiscard]] const SmoothLevel& level(float scale_px, int coarser = 0) const;
};

/// `grey`: 8 bit, one channel, not empty, else `std::invalid_argument`. Levels for scales up to
/// `max_scale_px`, fewer if the image would get smaller than 2 x 2. O(pixels), in parallel.
SmoothPyramid smooth_pyramid(const cv::Mat& grey, float max_scale_px);

}  // namespace vo
