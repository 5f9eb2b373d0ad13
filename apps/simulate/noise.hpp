#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

namespace simulate {

/// 32 well mixed bits of a lattice point.
std::uint32_t lattice_hash(std::int32_t x, std::int32_t y, std::uint32_t seed);

/// Uniform in [0, 1) for a lattice point.
float lattice_uniform(std::int32_t x, std::int32_t y, std::uint32_t seed);

/// Smooth value noise in [-1, 1] with features of size 1.
float value_noise(float x, float y, std::uint32_t seed);

/// Octaves of value noise, each twice as fine and `gain` times as strong, scaled to [-1, 1]: texture at every
/// scale from 1 down to 2^(1 - octaves).
float fractal_noise(float x, float y, int octaves, std::uint32_t seed, float gain = 0.6F);

/// An image of fractal noise in [-1, 1] whose largest features measure `feature_px`, down to single pixels.
/// It shows the part from `origin_px` on of a plane without end: images of neighbouring parts meet without a
/// seam.
cv::Mat1f fractal_image(cv::Size size, cv::Size2d feature_px, std::uint32_t seed, cv::Point2d origin_px = {});

}  // namespace simulate
