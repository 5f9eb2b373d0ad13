#pragma once

#include <optional>

#include <opencv2/core/mat.hpp>

namespace vo {

/// How much a picture shows.
struct PictureQuality {
  double level = 0;  ///< mean grey level, 0 (black) to 255
  /// 0 (every pixel differs from its neighbour) to 1 (smooth); none where all pixels are equal. Sharp
  /// pictures of walks have 0.2 to 0.35; blurred by a Gaussian of 3 pixels they have 0.57.
  std::optional<double> blur;
};

/// Measures a grey picture of 8 bits, reduced to at most 640 columns. Blur is by how much a picture loses
/// when it is smoothed: the share of the differences between neighbouring pixels that stays after a mean over
/// nine pixels, along rows or columns, whichever is more [Crete, Dolmiere, Ladret, Nicolas: The blur effect:
/// perception and estimation with a new no-reference perceptual blur metric, 2007]. Neither brightness nor
/// contrast changes it; noise lowers it. Throws `std::invalid_argument` for another type or an empty picture.
/// About 2 ms for 640x360.
PictureQuality picture_quality(const cv::Mat& grey);

}  // namespace vo
