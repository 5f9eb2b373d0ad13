#pragma once

#include "vo/geometry/camera.hpp"
#include "vo/tracks/tracking_window.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vo {

enum class HeadingMethod {
  kNaive,     ///< median x shift / pixels per degree (PVO 4.5)
  kRegions,   ///< median over vertical strips of the median turn in each (PVO 4.5, "regions")
  kEpipolar,  ///< rotation of the essential matrix over the same tracks, by robust least squares
};

/// Settings of `turn`.
struct HeadingOptions {
  HeadingMethod method = HeadingMethod::kEpipolar;
  int strips = 8;         ///< of `kRegions`, and where `kEpipolar` starts; >= 1
  int min_points = 8;     ///< fewer tracked points give no answer
  double noise_px = 0.5;  ///< standard deviation of a point's position, for `kEpipolar`

  /// True if every field is in its range; else says in `*error` which is not.
  [[nodiscard]] bool is_valid(std::string* error) const;
};

/// How far the camera turned between the two ends of the tracks.
struct Turn {
  double turn_rad = 0;  ///< clockwise seen from above positive, if the walker goes where the camera looks
  /// Change of `turn_rad` for each radian that the walker goes to the right of where the camera looks; 0
  /// except for `kEpipolar`.
  double turn_per_travel = 0;
  std::optional<double> travel_rad;  ///< that angle, if these points show it
};

/// The turn of the camera, or none if too few points were tracked.
///
/// A camera that turns right moves the picture to the left (PVO 4.5). Walking forward also spreads it from
/// the point that the walker heads for, more so for near things. The median cancels this only where both
/// sides are alike:
///  - `kNaive` is the paper's: every point counts the same, and every pixel spans the mean number of degrees.
///  - `kRegions` gives each strip one vote, so that neither a passer-by in one strip nor a side with more
///    texture looks like a turn. The paper names regions and leaves their form open; angles are those of the
///    camera's rays.
///  - `kEpipolar` solves for the rotation and the direction of travel, which together explain the spread: it
///    minimises the Sampson distances of b' [t]x R a = 0 with Cauchy weights (Hartley and Zisserman 2004,
///    11.4 and A6.8), from `kRegions`, by Gauss-Newton. One frame cannot tell a turn from a step to the side
///    in front of a wall; a whole walk can, since the camera is fixed to the walker. So the turn given is the
///    one for travel with no sideways part (up and down is solved for), together with its change for travel
///    to the side and the direction this frame alone shows; `gait_signal` joins them.
///
/// Throws `std::invalid_argument` if options are invalid. O(points) for each iteration.
std::optional<Turn> turn(std::span<const TrackedPoint> points, const Camera& camera,
                         const HeadingOptions& options = {});

}  // namespace vo
