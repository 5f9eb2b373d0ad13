#include "sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include <vo/base/rng.hpp>

namespace simulate {
namespace {

constexpr std::size_t kTableSize = 1U << 16U;

// Normal deviates in sixteenths. A frame reads runs of it from random places, one per row.
const std::array<std::int16_t, kTableSize>& normal_table() {
  static const auto table = [] {
    std::array<std::int16_t, kTableSize> values{};
    vo::Rng rng(20170101);
    for (auto& value : values) value = static_cast<std::int16_t>(std::lround(16 * rng.normal()));
    return values;
  }();
  return table;
}

}  // namespace

Exposure exposure_for(Condition condition) {
  switch (condition) {
    // A phone's habits: short and clean in the sun; a whole 1/30 s, and what gain is left, in the dark.
    case Condition::kDay:
      return {1 / 500.0, 1, 1.2};
    case Condition::kNight:
      return {1 / 30.0, 3, 4.5};
    case Condition::kRain:
      return {1 / 100.0, 1, 2.0};
  }
  throw std::invalid_argument("exposure_for: unknown condition");
}

cv::Mat average(const std::vector<cv::Mat>& images) {
  if (images.empty()) throw std::invalid_argument("average: at least one image expected");
  if (images.size() == 1) return images.front();
  cv::Mat sum;
  images.front().convertTo(sum, CV_16U);
  for (std::size_t i = 1; i < images.size(); ++i) cv::add(sum, images[i], sum, cv::noArray(), CV_16U);
  cv::Mat mean;
  sum.convertTo(mean, CV_8U, 1.0 / static_cast<double>(images.size()));
  return mean;
}

void add_noise(cv::Mat& bgr, double deviation, std::uint64_t seed) {
  const auto& table = normal_table();
  const int scale = static_cast<int>(std::lround(deviation * 16));  // 256 in all with the table's sixteenths
  const int width = bgr.cols * 3;
  vo::Rng rng(seed);
  for (int y = 0; y < bgr.rows; ++y) {
    auto* row = bgr.ptr<std::uint8_t>(y);
    for (int begin = 0; begin < width; begin += static_cast<int>(kTableSize / 2)) {
      const int count = std::min(width - begin, static_cast<int>(kTableSize / 2));
      const std::int16_t* noise = table.data() + rng.index(kTableSize / 2);
      for (int x = 0; x < count; ++x) {
        row[begin + x] =
            static_cast<std::uint8_t>(std::clamp(row[begin + x] + ((noise[x] * scale + 128) >> 8), 0, 255));
      }
    }
  }
}

void add_raindrops(cv::Mat& bgr, int count, std::uint64_t seed) {
  vo::Rng rng = vo::Rng(seed).split();
  for (int i = 0; i < count; ++i) {
    const int x = static_cast<int>(rng.index(static_cast<std::uint64_t>(bgr.cols)));
    const int top = static_cast<int>(rng.index(static_cast<std::uint64_t>(bgr.rows)));
    const int length = static_cast<int>(bgr.rows * rng.uniform(0.02, 0.1));
    const int lighter = static_cast<int>(rng.uniform(12, 40));
    for (int y = top; y < std::min(bgr.rows, top + length); ++y) {
      auto& pixel = bgr.at<cv::Vec3b>(y, std::min(bgr.cols - 1, x + (y - top) / 8));
      for (int c = 0; c < 3; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(pixel[c] + lighter);
    }
  }
}

}  // namespace simulate
