#include "noise.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace simulate {
namespace {

// A world of texels is painted with these, so they avoid the calls behind std::floor and std::lerp.
std::int32_t floor_to_int(float x) {
  const auto i = static_cast<std::int32_t>(x);
  return static_cast<float>(i) > x ? i - 1 : i;
}

float smooth(float t) {
  return t * t * (3 - 2 * t);
}

float mix(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^ static_cast<std::uint32_t>(y) * 0x85ebca77U;
  h = (h ^ seed ^ (h >> 15U)) * 0x2c1b3c6dU;
  h = (h ^ (h >> 12U)) * 0x297a2d39U;
  return h ^ (h >> 15U);
}

float lattice_uniform(std::int32_t x, std::int32_t y, std::uint32_t seed) {
  return static_cast<float>(lattice_hash(x, y, seed) >> 8U) * 0x1.0p-24F;
}

float value_noise(float x, float y, std::uint32_t seed) {
  const std::int32_t ix = floor_to_int(x);
  const std::int32_t iy = floor_to_int(y);
  const float tx = smooth(x - static_cast<float>(ix));
  const float ty = smooth(y - static_cast<float>(iy));
  const float top = mix(lattice_uniform(ix, iy, seed), lattice_uniform(ix + 1, iy, seed), tx);
  const float bottom = mix(lattice_uniform(ix, iy + 1, seed), lattice_uniform(ix + 1, iy + 1, seed), tx);
  return 2 * mix(top, bottom, ty) - 1;
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

cv::Mat1f fractal_image(cv::Size size, cv::Size2f feature_px, std::uint32_t seed, float gain) {
  cv::Mat1f sum = cv::Mat1f::zeros(size);
  float weight = 1, total = 0;
  cv::Size2f feature = feature_px;
  for (std::uint32_t octave = 0;; ++octave) {
    // One lattice value per feature, blown up; two more so that the interpolation never sees the lattice's
    // edge.
    const cv::Size lattice_size(static_cast<int>(static_cast<float>(size.width) / feature.width) + 3,
                                static_cast<int>(static_cast<float>(size.height) / feature.height) + 3);
    cv::Mat1f lattice(lattice_size);
    for (int y = 0; y < lattice.rows; ++y) {
      for (int x = 0; x < lattice.cols; ++x)
        lattice(y, x) = 2 * lattice_uniform(x, y, seed + octave * 0x632be5abU) - 1;
    }
    const cv::Matx23d lattice_from_image(1 / feature.width, 0, 0.5, 0, 1 / feature.height, 0.5);
    cv::Mat layer;
    cv::warpAffine(lattice, layer, lattice_from_image, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    cv::scaleAdd(layer, weight, sum, sum);
    total += weight;
    if (std::max(feature.width, feature.height) <= 1) break;
    weight *= gain;
    feature = {std::max(1.0F, feature.width / 2), std::max(1.0F, feature.height / 2)};
  }
  return sum / total;
}

}  // namespace simulate
