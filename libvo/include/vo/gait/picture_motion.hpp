#pragma once

#include "vo/tracks/tracking_window.hpp"

#include <optional>
#include <span>

namespace vo {

/// How the picture moves as a whole: about its middle, a point at (x, y) goes to
/// (x + right + growth * x - roll * y, y + down + growth * y + roll * x).
struct PictureMotion {
  double right_px = 0;
  double down_px = 0;
  double growth = 0;    ///< share by which it grows as things ahead come nearer
  double roll_rad = 0;  ///< clockwise
};

/// The motion that most of the points follow (not in PVO). It separates bounce from growth: the ground, which
/// fills half the picture, moves down as the camera moves forward.
///
/// Least squares with Cauchy weights, at one and a half times the median distance, starting at the mean
/// motion: near things and passers-by move differently. `width_px`, `height_px`: of the frames. None for
/// fewer than two points, or if all are in one place. O(points).
std::optional<PictureMotion> picture_motion(std::span<const TrackedPoint> points, int width_px,
                                            int height_px);

}  // namespace vo
