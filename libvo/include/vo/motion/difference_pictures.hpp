#pragma once

#include "vo/image/image_stack.hpp"
#include "vo/motion/alignment_error.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// How much each pixel changes over a time, in the mean over a walk.
struct DifferencePicture {
  double seconds = 0;     ///< mean time between the images compared
  std::size_t pairs = 0;  ///< of images compared; 0: there were none, and all values are 0
  int width = 0;
  int height = 0;
  std::vector<double> mean;  ///< absolute difference of each pixel, grey levels, row-major
};

/// The spans of SSS Fig. 1a: images 1, 5 and 10 frames apart, at 25 frames/s.
inline constexpr std::size_t kPicturedSpans[] = {1, 5, 10};

/// SSS Fig. 1a: the absolute difference of two images, averaged over all pairs that are a span apart. What
/// stays, as sky and pavement, remains dark; what passes by grows with the span.
///
/// `images`: of the walk, as seen (not patch-normalised, which would make flat regions as loud as any);
/// `errors`: of the same walk, which says what is compared with what; `spans`: each 1 .. errors.spans();
/// `excluded`: one flag per frame, or none, as for `mean_errors`. One picture for each span. Sums are exact
/// integers. Throws `std::invalid_argument` for other sizes or spans. O(frames * pixels) for each span.
std::vector<DifferencePicture> difference_pictures(const ImageStack& images, const AlignmentErrors& errors,
                                                   std::span<const std::size_t> spans = kPicturedSpans,
                                                   const std::vector<bool>& excluded = {});

}  // namespace vo
