#include "noise.hpp"

#include <algorithm>
#include <cmath>

namespace simulate {
namespace {

float smooth(float t) {
  return t * t * (3 - 2 * t);
}

}  // namespace

std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  std::uint32_t h = seed;
  h ^= static_cast<std::uint32_t>(x) * 0x9e3779b1U;
  h = (h ^ (h >> 15U)) * 0x85ebca77U;
  h ^= static_cast<std::uint32_t>(y) * 0xc2b2ae3dU;
  h = (h ^ (h >> 13U)) * 0x27d4eb2fU;
  h = (h ^ (h >> 16U)) * 0x165667b1U;
  return h ^ (h >> 15U);
}

float lattice_uniform(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  return static_cast<float>(lattice_hash(x, y, seed) >> 8U) * 0x1.0p-24F;
}

float value_noise(float x, float y, std::uint32_t seed) {
  const float fx = std::floor(x);
  const float fy = std::floor(y);
  const auto ix = static_cast<std::int32_t>(fx);
  const auto iy = static_cast<std::int32_t>(fy);
  const float tx = smooth(x - fx);
  const float ty = smooth(y - fy);
  const float top = std::lerp(lattice_uniform(ix, iy, seed), lattice_uniform(ix + 1, iy, seed), tx);
  const float bottom =
      std::lerp(lattice_uniform(ix, iy + 1, seed), lattice_uniform(ix + 1, iy + 1, seed), tx);
  return 2 * std::lerp(top, bottom, ty) - 1;
}

float fractal_noise(float x, float y, int octaves, std::uint32_t seed, float gain) {
  float sum = 0, weight = 1, total = 0;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * value_noise(x, y, seed + static_cast<std::uint32_t>(octave) * 0x632be5abU);
    total += weight;
    weight *= gain;
    x *= 2;
    y *= 2;
  }
  return sum / total;
}

cv::Mat1f fractal_image(cv::Size size, cv::Size2f feature_px, std::uint32_t seed) {
  const float longest = std::max({feature_px.width, feature_px.height, 1.0F});
  const int octaves = 1 + static_cast<int>(std::log2(longest));
  cv::Mat1f image(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image(y, x) = fractal_noise(static_cast<float>(x) / feature_px.width,
                                  static_cast<float>(y) / feature_px.height, octaves, seed);
    }
  }
  return image;
}

}  // namespace simulate
