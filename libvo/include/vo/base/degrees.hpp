#pragma once

#include <numbers>

namespace vo {

inline constexpr double kDegPerRad = 180 / std::numbers::pi;
inline constexpr double kRadPerDeg = std::numbers::pi / 180;

/// A heading from -pi to pi as a compass shows it: degrees of at least 0, below 360.
inline double compass_deg(double heading_rad) {
  const double degrees = heading_rad * kDegPerRad;
  return degrees < 0 ? degrees + 360 : degrees;
}

}  // namespace vo
