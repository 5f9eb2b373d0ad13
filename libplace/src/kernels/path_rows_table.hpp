#pragma once

#include "kernels/path_rows.hpp"

#include <array>
#include <bit>
#include <cstdint>

/// Plain loops that compilers vectorise, compiled once for each instruction set.
namespace place::kernels {
namespace {

/// 2^x for |x| < 126: the nearest whole power, times a polynomial for the rest in [-1/2, 1/2].
inline float exp2_of(float x) {
  constexpr float kMagic = 12582912;  // 1.5 * 2^23: adding it rounds to a whole number
  const float shifted = x + kMagic;
  const float rest = x - (shifted - kMagic);
  const auto power = std::bit_cast<std::int32_t>(shifted) << 23;
  // Taylor's series of 2^x; the sixth term is below 1.6e-4 * 0.5^6.
  const float value =
      1 +
      rest * (0.69314718F +
              rest * (0.24022651F + rest * (0.055504109F + rest * (0.0096181291F + rest * 0.0013333558F))));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(value) + power);
}

inline void likelihoods(const float* costs, std::size_t count, float even, float slope, float furthest,
                        float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const float above = costs[i] > -furthest ? costs[i] : -furthest;
    const float cost = above < furthest ? above : furthest;
    out[i] = exp2_of((even - cost) * slope);
  }
}

inline void convolve(const float* from, std::size_t count, const float* taps, std::size_t tap_count,
                     float floor, float* __restrict to) {
  if (tap_count == 5) {  // the case of an evenly spaced walk
    const float a = taps[0], b = taps[1], c = taps[2], d = taps[3], e = taps[4];
    for (std::size_t i = 0; i < count; ++i)
      to[i] = floor + a * from[i] + b * from[i + 1] + c * from[i + 2] + d * from[i + 3] + e * from[i + 4];
    return;
  }
  for (std::size_t i = 0; i < count; ++i) to[i] = floor;
  for (std::size_t k = 0; k < tap_count; ++k) {
    const float tap = taps[k];
    for (std::size_t i = 0; i < count; ++i) to[i] += tap * from[i + k];
  }
}

inline double total_of(const std::array<float, kLanes>& lanes) {
  double sum = 0;
  for (const float lane : lanes) sum += static_cast<double>(lane);
  return sum;
}

inline double multiply(const float* a, const float* b, std::size_t count, float* out) {
  std::array<float, kLanes> sums{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    std::array<float, kLanes> product;
    for (std::size_t j = 0; j < kLanes; ++j) product[j] = a[i + j] * b[i + j];
    for (std::size_t j = 0; j < kLanes; ++j) sums[j] += product[j];
    for (std::size_t j = 0; j < kLanes; ++j) out[i + j] = product[j];
  }
  for (std::size_t j = 0; i < count; ++i, ++j) {
    out[i] = a[i] * b[i];
    sums[j] += out[i];
  }
  return total_of(sums);
}

inline ChunkTotals multiply_chunk(const float* a, const float* b, std::size_t count, float* out) {
  std::array<float, kLanes> sums{}, most{};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    std::array<float, kLanes> product;
    for (std::size_t j = 0; j < kLanes; ++j) product[j] = a[i + j] * b[i + j];
    for (std::size_t j = 0; j < kLanes; ++j) sums[j] += product[j];
    for (std::size_t j = 0; j < kLanes; ++j) most[j] = most[j] < product[j] ? product[j] : most[j];
    for (std::size_t j = 0; j < kLanes; ++j) out[i + j] = product[j];
  }
  for (std::size_t j = 0; i < count; ++i, ++j) {
    out[i] = a[i] * b[i];
    sums[j] += out[i];
    most[j] = most[j] < out[i] ? out[i] : most[j];
  }
  float highest = 0;
  for (const float lane : most) highest = highest < lane ? lane : highest;
  return {total_of(sums), highest};
}

constexpr PathKernels kPathTable{likelihoods, convolve, multiply, multiply_chunk};

}  // namespace
}  // namespace place::kernels
