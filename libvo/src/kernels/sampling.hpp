#pragma once

#include "kernels/kernels.hpp"

namespace vo::kernels {

/// Rows x Columns samples of a grid whose middle is row and column `kMiddle`, between pixels linear, outside
/// the image as on its rim.
template <class Lanes, int kRows, int kColumns, int kMiddle>
void sample_grid(const Raster& raster, const Grid& grid, float (&out)[kRows][kColumns]) {
  const auto zero = Lanes::all(0.0F);
  const auto last_column = Lanes::all(raster.last_column), last_row = Lanes::all(raster.last_row);
  const auto stride = Lanes::all(static_cast<std::uint32_t>(raster.stride));
  float offsets[kColumns];
  for (int c = 0; c < kColumns; ++c) offsets[c] = static_cast<float>(c - kMiddle);
  for (int r = 0; r < kRows; ++r) {
    const float dv = static_cast<float>(r - kMiddle);
    const auto row_x = Lanes::all(grid.x + dv * grid.vx), row_y = Lanes::all(grid.y + dv * grid.vy);
    for (int c = 0; c < kColumns; c += Lanes::kCount) {
      const auto du = Lanes::load(offsets + c);
      const auto x =
          Lanes::min(Lanes::max(Lanes::add(row_x, Lanes::mul(du, Lanes::all(grid.ux))), zero), last_column);
      const auto y =
          Lanes::min(Lanes::max(Lanes::add(row_y, Lanes::mul(du, Lanes::all(grid.uy))), zero), last_row);
      const auto column = Lanes::to_int(x), line = Lanes::to_int(y);
      const auto s = Lanes::sub(x, Lanes::to_float(column)), t = Lanes::sub(y, Lanes::to_float(line));
      const auto index = Lanes::add(Lanes::mul(line, stride), column);
      const auto across = [&](typename Lanes::Int pair) {
        const auto left = Lanes::to_float(Lanes::low_half(pair));
        const auto right = Lanes::to_float(Lanes::high_half(pair));
        return Lanes::add(left, Lanes::mul(s, Lanes::sub(right, left)));
      };
      const auto upper = across(Lanes::pair_at(raster.values, index));
      const auto lower = across(Lanes::pair_at(raster.values + raster.stride, index));
      Lanes::store(&out[r][c], Lanes::add(upper, Lanes::mul(t, Lanes::sub(lower, upper))));
    }
  }
}

}  // namespace vo::kernels
