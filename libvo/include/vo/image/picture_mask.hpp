#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Parts of every picture of a walk that are not the scene: a clock drawn over it, a bonnet, a strap.
///
/// Masked parts are filled smoothly from around them, by the push-pull pyramid of Gortler, Grzeszczuk,
/// Szeliski, Cohen: The Lumigraph, 1996, section 3.4. So trackers find no edge there that stands still, and
/// thumbnails no pattern to agree on.
class PictureMask {
 public:
  /// `keep`: 8 bits, grey, of the pictures' size; black (below 128) is masked. Throws `std::invalid_argument`
  /// if nothing is kept.
  explicit PictureMask(const cv::Mat& keep);

  /// Fills a picture's masked parts; 8 bits, of one or three channels, of the mask's size
  /// (`std::invalid_argument`). O(pixels).
  void fill(cv::Mat& picture) const;

 private:
  std::vector<cv::Mat> weight_;  ///< share of each pixel that is kept, by level, each half the size
};

}  // namespace vo
