#pragma once

#include <optional>
#include <span>

namespace place {

/// From a known place, the direction in which a place lies that is sought.
struct Bearing {
  double x_m = 0, y_m = 0;  ///< the known place
  double bearing_rad = 0;   ///< clockwise from +y
};

/// Where bearings cross.
struct CrossedPlace {
  double x_m = 0, y_m = 0;
  double x_sd_m = 0, y_sd_m = 0;  ///< standard deviations
};

/// The place where bearings cross, by least squares of its distances from their lines, each weighted by what
/// it is worth there (a bearing is off by an angle, so far places say less) and less if it lies off (Cauchy's
/// weights), or behind its known place. The place is sought about (0, 0), where it is within some 3 m along y
/// and 10 m along x beforehand: bearings along one line leave it there, and the standard deviations say so.
/// None for fewer than 2 bearings, or if most lie off. O(bearings).
std::optional<CrossedPlace> cross_bearings(std::span<const Bearing> bearings);

}  // namespace place
