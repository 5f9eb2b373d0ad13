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

cv::Mat1f fractal_image(cv::Size size, cv::Size2d feature_px, std::uint32_t seed, cv::Point2d origin_px) {
  constexpr float kGain = 0.7F;
  cv::Mat1f sum = cv::Mat1f::zeros(size);
  float weight = 1, total = 0;
  cv::Size2d feature = feature_px;
  for (std::uint32_t octave = 0;; ++octave, weight *= kGain) {
    // One lattice value per feature, blown up; two more so that the interpolation never meets the lattice's
    // edge.
    const double left = origin_px.x / feature.width, top = origin_px.y / feature.height;
    const auto first_x = static_cast<std::int32_t>(std::floor(left));
    const auto first_y = static_cast<std::int32_t>(std::floor(top));
    cv::Mat1f lattice(static_cast<int>(size.height / feature.height) + 3,
                      static_cast<int>(size.width / feature.width) + 3);
    for (int y = 0; y < lattice.rows; ++y) {
      for (int x = 0; x < lattice.cols; ++x) {
        lattice(y, x) = 2 * lattice_uniform(first_x + x, first_y + y, seed + octave * 0x632be5abU) - 1;
      }
    }
    const cv::Matx23d lattice_from_image(1 / feature.width, 0, left - first_x, 0, 1 / feature.height,
                                         top - first_y);
    cv::Mat layer;
    cv::warpAffine(lattice, layer, lattice_from_image, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    cv::scaleAdd(layer, weight, sum, sum);
    total += weight;
    if (std::max(feature.width, feature.height) <= 1) break;
    feature = {std::max(1.0, feature.width / 2), std::max(1.0, feature.height / 2)};
  }
  return sum / total;
}

}  // namespace simulate
