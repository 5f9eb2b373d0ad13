#pragma once

#include "vo/gait/gait_signal.hpp"
#include "vo/image/image_stack.hpp"

#include <vector>

#include <opencv2/core/types.hpp>

namespace vo {

/// How the picture moves as a whole from each thumbnail to the next (not in PVO): `picture_motion` without
/// points, crude, for walks of which nothing else was kept. The first frame has none, nor has a frame without
/// contrast.
///
/// Lucas and Kanade's registration by one shift, growth, roll and change of brightness for the whole picture,
/// in least squares with Cauchy weights, from coarse to fine. `thumbnails`: grey; `frame`: the size in pixels
/// of the pictures they are of, in which the motion is given. Only `picture` and `window` are filled.
/// O(frames * pixels), in parallel; takes six times the memory of the thumbnails.
std::vector<FrameMotion> thumbnail_motion(const ImageStack& thumbnails, cv::Size frame);

}  // namespace vo
