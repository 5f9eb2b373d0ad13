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
  double growth = 0;    ///< share by which it grows: what is ahead comes nearer
  double roll_rad = 0;  ///< clockwise
};

/// The motion that moves most of the points (not in PVO), so that how far the picture bounces is told from
/// how much it grows: the ground, which fills half of it, moves down when one walks on.
///
/// Least squares with Cauchy weights, at one and a half times the median distance, from the mean motion:
/// things near and passers-by move otherwise. `width_px`, `height_px`: of the frames. None for fewer than two
/// points, or where all are in one place. O(points).
std::optional<PictureMotion> picture_motion(std::span<const TrackedPoint> points, int width_px,
                                            int height_px);

}  // namespace vo
