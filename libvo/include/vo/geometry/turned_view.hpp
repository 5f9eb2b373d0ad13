#pragma once

#include "vo/geometry/camera.hpp"

#include <opencv2/core/matx.hpp>

namespace vo {

/// What a turned camera sees, from the picture of one that was not: the homography K_to R K_from^-1 that
/// takes pixels of `from` to pixels of `to`, a camera in the same place turned by `turn_rad` to the right
/// [Hartley, Zisserman: Multiple View Geometry, 2004, 8.4.2]. It is exact for a turn alone; a camera that
/// also stands elsewhere sees near things shifted. Distortion of the lenses is left out. Throws
/// `std::invalid_argument` unless both have focal lengths and the turn is less than a right angle.
cv::Matx33d turned_view(const Camera& from, const Camera& to, double turn_rad);

}  // namespace vo
