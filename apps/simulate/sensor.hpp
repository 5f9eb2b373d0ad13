#pragma once

#include "options.hpp"

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace simulate {

/// How a camera exposes under a condition.
struct Exposure {
  double shutter_s;  ///< for how long
  int samples;       ///< rendered moments averaged over it
  double noise;      ///< standard deviation in grey levels
};

Exposure exposure_for(Condition condition);

/// The average of images of one size and type CV_8UC3, at least one.
cv::Mat average(const std::vector<cv::Mat>& images);

/// Adds Gaussian noise. The same seed gives the same noise.
void add_noise(cv::Mat& bgr, double deviation, std::uint64_t seed);

/// Adds falling drops: thin pale streaks, others in every frame.
void add_raindrops(cv::Mat& bgr, int count, std::uint64_t seed);

}  // namespace simulate
