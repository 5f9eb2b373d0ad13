#include "noise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

// Where samples fall between the values of a lattice: index of the value before, share of the one after.
struct Between {
  std::int32_t index;
  float share;
};

std::vector<Between> lattice_positions(int count, double origin_px, double feature_px) {
  std::vector<Between> positions(static_cast<std::size_t>(count));
  const double first = std::floor(origin_px / feature_px);
  for (int i = 0; i < count; ++i) {
    const double at = (origin_px + i) / feature_px - first;
    const auto index = static_cast<std::int32_t>(at);
    positions[static_cast<std::size_t>(i)] = {index, static_cast<float>(at - index)};
  }
  return positions;
}

// Adds bilinear noise with features of one size to an image.
void add_octave(cv::Mat1f& image, cv::Size2d feature, cv::Point2d origin, float weight, std::uint32_t seed) {
  const std::vector<Between> columns = lattice_positions(image.cols, origin.x, feature.width);
  const std::vector<Between> rows = lattice_positions(image.rows, origin.y, feature.height);
  const auto first_x = static_cast<std::int32_t>(std::floor(origin.x / feature.width));
  const auto first_y = static_cast<std::int32_t>(std::floor(origin.y / feature.height));
  cv::Mat1f lattice(rows.back().index + 2, columns.back().index + 2);
  for (int y = 0; y < lattice.rows; ++y) {
    for (int x = 0; x < lattice.cols; ++x) {
      lattice(y, x) = weight * (2 * lattice_uniform(first_x + x, first_y + y, seed) - 1);
    }
  }
  std::vector<float> blend(static_cast<std::size_t>(lattice.cols));
  for (int y = 0; y < image.rows; ++y) {
    const Between& row = rows[static_cast<std::size_t>(y)];
    const float* above = lattice[row.index];
    const float* below = lattice[row.index + 1];
    for (std::size_t x = 0; x < blend.size(); ++x) blend[x] = mix(above[x], below[x], row.share);
    float* out = image[y];
    for (const Between& column : columns) {
      const float* value = blend.data() + column.index;
      *out++ += mix(value[0], value[1], column.share);
    }
  }
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
  for (;; weight *= kGain, seed += 0x632be5abU) {
    add_octave(sum, feature, origin_px, weight, seed);
    total += weight;
    if (std::max(feature.width, feature.height) <= 1) break;
    feature = {std::max(1.0, feature.width / 2), std::max(1.0, feature.height / 2)};
  }
  return sum / total;
}

}  // namespace simulate
