#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Sums of all pixels above and to the left (Bay et al. 2008, Eq. 1; Viola and Jones 2001), from which the
/// sum over any box takes four look-ups. Exact: an image has at most 2^24 pixels, 4096 x 4096, whose sum fits
/// 32 bits.
struct IntegralImage {
  static constexpr std::size_t kMaxPixels = std::size_t{1} << 24;

  int width = 0;   ///< pixels; a row has width + 1 sums and some padding
  int height = 0;  ///< pixels; there are height + 1 rows
  std::ptrdiff_t stride = 0;
  std::vector<std::uint32_t> sums;

  /// Sums over the pixels above row y: [x] those left of column x.
  [[nodiscard]] const std::uint32_t* row(int y) const { return sums.data() + y * stride; }

  /// Sum over columns [x0, x1) and rows [y0, y1), which must lie in the image. Unchecked.
  [[nodiscard]] std::uint32_t box(int x0, int y0, int x1, int y1) const {
    return row(y1)[x1] - row(y1)[x0] - row(y0)[x1] + row(y0)[x0];
  }
};

/// `grey`: 8 bit, one channel, may be empty. Throws `std::invalid_argument` if it is not so, or has more than
/// `kMaxPixels`. O(pixels).
IntegralImage integral_image(const cv::Mat& grey);

/// The integral image of the image whose pixels are the sums of `factor` x `factor` pixels: every factor-th
/// row and column of the sums. Rows and columns left over at the end are dropped. `factor` >= 1, else
/// `std::invalid_argument`. O(pixels / factor^2).
IntegralImage coarser(const IntegralImage& integral, int factor);

}  // namespace vo
