#pragma once

#include "world.hpp"

#include <cstdint>

#include <opencv2/core.hpp>

namespace simulate {

/// Paints the front of a house: wall, windows by floors, a ground floor of shops or doors, signs, dirt. Every
/// seed is another house: material, colour, proportions and all that hangs on it.
Painter facade_painter(cv::Size2d extent_m, std::uint64_t seed);

/// Paints the side of the same house: its wall and a few windows.
Painter side_wall_painter(cv::Size2d extent_m, std::uint64_t seed);

}  // namespace simulate
