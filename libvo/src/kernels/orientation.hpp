#pragma once

#include "kernels/kernels.hpp"
#include "kernels/sampling.hpp"

namespace vo::kernels {

template <class Lanes>
void orientation_moments(const Raster& raster, const Grid& grid, const OrientationWeights& weights,
                         OrientationMoments& moments) {
  constexpr int kRows = kOrientationRows + 2, kColumns = kOrientationColumns + Lanes::kCount;
  float samples[kRows][kOrientationColumns];
  sample_grid<Lanes, kRows, kOrientationColumns, kOrientationRadius + 1>(raster, grid, samples);
  float padded[kRows][kColumns];  // a gradient looks one sample past its last
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < kColumns; ++c)
      padded[r][c] = samples[r][c < kOrientationColumns ? c : kOrientationColumns - 1];
  }

  typename Lanes::Float sums[2 * kOrientationHarmonics];
  for (auto& sum : sums) sum = Lanes::all(0.0F);
  const auto four = Lanes::all(4.0F), tiny = Lanes::all(1e-12F);
  for (int r = 0; r < kOrientationRows; ++r) {
    for (int c = 0; c < kOrientationColumns; c += Lanes::kCount) {
      const auto at = [&](int dr, int dc) { return Lanes::load(&padded[r + dr][c + dc]); };
      // (1, 4, 1) across the difference: its direction has no error of second order in the spacing.
      const auto gx = Lanes::add(Lanes::mul(four, Lanes::sub(at(1, 2), at(1, 0))),
                                 Lanes::add(Lanes::sub(at(0, 2), at(0, 0)), Lanes::sub(at(2, 2), at(2, 0))));
      const auto gy = Lanes::add(Lanes::mul(four, Lanes::sub(at(2, 1), at(0, 1))),
                                 Lanes::add(Lanes::sub(at(2, 0), at(0, 0)), Lanes::sub(at(2, 2), at(0, 2))));
      const auto length = Lanes::sqrt(Lanes::add(Lanes::mul(gx, gx), Lanes::mul(gy, gy)));
      const auto inverse = Lanes::div(Lanes::all(1.0F), Lanes::max(length, tiny));
      const auto ux = Lanes::mul(gx, inverse), uy = Lanes::mul(gy, inverse);
      const auto weight = Lanes::load(&weights.values[r][c]);
      auto zx = Lanes::mul(weight, gx), zy = Lanes::mul(weight, gy);
      for (int m = 0; m < kOrientationHarmonics; ++m) {
        sums[2 * m] = Lanes::add(sums[2 * m], zx);
        sums[2 * m + 1] = Lanes::add(sums[2 * m + 1], zy);
        const auto next = Lanes::sub(Lanes::mul(zx, ux), Lanes::mul(zy, uy));
        zy = Lanes::add(Lanes::mul(zx, uy), Lanes::mul(zy, ux));
        zx = next;
      }
    }
  }
  for (int i = 0; i < 2 * kOrientationHarmonics; ++i) moments.values[i] = Lanes::sum(sums[i]);
}

}  // namespace vo::kernels
