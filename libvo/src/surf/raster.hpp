#pragma once

#include "kernels/kernels.hpp"
#include "vo/surf/features.hpp"
#include "vo/surf/smooth_pyramid.hpp"

#include <cmath>

namespace vo {

/// A level as the kernels take it.
inline kernels::Raster raster_of(const SmoothLevel& level) {
  return {.values = level.values.data(),
          .stride = level.stride,
          .last_column = static_cast<float>(level.width - 1),
          .last_row = static_cast<float>(level.height - 1)};
}

/// A grid about a point on a level, its samples `spacing_px` of the image apart, turned by an angle.
inline kernels::Grid grid_at(const SmoothLevel& level, const Feature& point, float spacing_px,
                             float angle_rad) {
  const float shrink = 1 / static_cast<float>(level.step_px);
  const float u = spacing_px * shrink * std::cos(angle_rad), v = spacing_px * shrink * std::sin(angle_rad);
  return {.x = point.x_px * shrink, .y = point.y_px * shrink, .ux = u, .uy = v, .vx = -v, .vy = u};
}

}  // namespace vo
