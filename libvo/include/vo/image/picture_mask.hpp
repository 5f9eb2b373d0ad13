#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

namespace vo {

/// Parts of every picture of a walk that are not the scene: a clock drawn over it, a bonnet, a strap.
///
/// What is masked is filled smoothly from around it, by pushing and pulling through a pyramid [Gortler,
/// Grzeszczuk, Szeliski, Cohen: The Lumigraph, 1996, section 3.4]: no edge that stands still is left for
/// trackers to follow, and no pattern for thumbnails to agree on.
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
