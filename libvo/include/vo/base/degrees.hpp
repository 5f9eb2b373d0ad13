#pragma once

#include <numbers>

namespace vo {

inline constexpr double kDegPerRad = 180 / std::numbers::pi;
inline constexpr double kRadPerDeg = std::numbers::pi / 180;

}  // namespace vo
