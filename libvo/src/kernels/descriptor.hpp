#pragma once

#include "kernels/kernels.hpp"
#include "kernels/sampling.hpp"

namespace vo::kernels {

template <class Lanes, bool kExtended>
void descriptor_sums(const Raster& raster, const Grid& grid, const DescriptorWeights& weights, float* out) {
  constexpr int kSamples = kDescriptorSamples, kColumns = kDescriptorColumns;
  constexpr int kSums = kExtended ? 8 : 4, kVectors = kColumns / Lanes::kCount;
  float samples[kSamples + 1][kColumns];
  sample_grid<Lanes, kSamples + 1, kColumns, kSamples / 2>(raster, grid, samples);

  // Haar wavelets of two samples a side, between the samples.
  float dx[kSamples][kColumns], dy[kSamples][kColumns];
  for (int r = 0; r < kSamples; ++r) {
    float next[2][kColumns + Lanes::kCount] = {};
    for (int i = 0; i < 2; ++i) {
      for (int c = 0; c < kColumns; ++c) next[i][c] = samples[r + i][c];
    }
    for (int c = 0; c < kColumns; c += Lanes::kCount) {
      const auto a = Lanes::load(&next[0][c]), b = Lanes::load(&next[0][c + 1]);
      const auto d = Lanes::load(&next[1][c]), e = Lanes::load(&next[1][c + 1]);
      Lanes::store(&dx[r][c], Lanes::add(Lanes::sub(b, a), Lanes::sub(e, d)));
      Lanes::store(&dy[r][c], Lanes::add(Lanes::sub(d, a), Lanes::sub(e, b)));
    }
  }

  for (int i = 0; i < kDescriptorCells; ++i) {
    typename Lanes::Float columns[kVectors][kSums];
    for (int v = 0; v < kVectors; ++v) {
      auto& sums = columns[v];
      for (auto& sum : sums) sum = Lanes::all(0.0F);
      for (int r = 0; r < kSamples; ++r) {
        const float row_weight = weights.values[i][r];
        if (row_weight == 0) continue;
        const auto weight = Lanes::all(row_weight);
        const auto x = Lanes::mul(weight, Lanes::load(&dx[r][v * Lanes::kCount]));
        const auto y = Lanes::mul(weight, Lanes::load(&dy[r][v * Lanes::kCount]));
        const auto x_abs = Lanes::abs(x), y_abs = Lanes::abs(y);
        if constexpr (kExtended) {
          const auto x_up = Lanes::where_positive(y, x), x_abs_up = Lanes::where_positive(y, x_abs);
          const auto y_right = Lanes::where_positive(x, y), y_abs_right = Lanes::where_positive(x, y_abs);
          sums[0] = Lanes::add(sums[0], x_up);
          sums[1] = Lanes::add(sums[1], Lanes::sub(x, x_up));
          sums[2] = Lanes::add(sums[2], y_right);
          sums[3] = Lanes::add(sums[3], Lanes::sub(y, y_right));
          sums[4] = Lanes::add(sums[4], x_abs_up);
          sums[5] = Lanes::add(sums[5], Lanes::sub(x_abs, x_abs_up));
          sums[6] = Lanes::add(sums[6], y_abs_right);
          sums[7] = Lanes::add(sums[7], Lanes::sub(y_abs, y_abs_right));
        } else {
          sums[0] = Lanes::add(sums[0], x);
          sums[1] = Lanes::add(sums[1], y);
          sums[2] = Lanes::add(sums[2], x_abs);
          sums[3] = Lanes::add(sums[3], y_abs);
        }
      }
    }
    for (int j = 0; j < kDescriptorCells; ++j) {
      for (int k = 0; k < kSums; ++k) {
        auto sum = Lanes::all(0.0F);
        for (int v = 0; v < kVectors; ++v) {
          const auto weight = Lanes::load(&weights.values[j][v * Lanes::kCount]);
          sum = Lanes::add(sum, Lanes::mul(weight, columns[v][k]));
        }
        *out++ = Lanes::sum(sum);
      }
    }
  }
}

}  // namespace vo::kernels
