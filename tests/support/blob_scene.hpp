#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <opencv2/core.hpp>

#include <vo/base/rng.hpp>

namespace test_support {

/// Elongated Gaussian blobs on grey, drawn from their formula, so that a turned or scaled picture has no
/// error but the rounding to bytes.
class BlobScene {
 public:
  BlobScene(int count, double half_width_px, double half_height_px, std::uint64_t seed) {
    vo::Rng rng(seed);
    for (int i = 0; i < count; ++i) {
      const double size_px = rng.uniform(1.8, 5);
      blobs_.push_back({.x = rng.uniform(-half_width_px, half_width_px),
                        .y = rng.uniform(-half_height_px, half_height_px),
                        .long_px = size_px * rng.uniform(1, 1.8),
                        .short_px = size_px,
                        .angle = rng.uniform(0, std::numbers::pi),
                        .height = rng.uniform(20, 70) * (rng.uniform() < 0.5 ? -1 : 1)});
    }
  }

  /// The scene about the middle of the picture, turned clockwise by `angle_rad` and enlarged by `scale`.
  [[nodiscard]] cv::Mat draw(cv::Size size, double angle_rad = 0, double scale = 1) const {
    cv::Mat1f sum(size, 128.0F);
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    for (const Blob& blob : blobs_) {
      const double x = scale * (c * blob.x - s * blob.y) + (size.width - 1) / 2.0;
      const double y = scale * (s * blob.x + c * blob.y) + (size.height - 1) / 2.0;
      const double u = std::cos(blob.angle + angle_rad), v = std::sin(blob.angle + angle_rad);
      const double reach = 5 * scale * blob.long_px;  // beyond, less than 70 exp(-12.5) = 0.0003 grey levels
      for (int row = std::max(0, static_cast<int>(y - reach)); row < std::min<double>(size.height, y + reach);
           ++row) {
        for (int column = std::max(0, static_cast<int>(x - reach));
             column < std::min<double>(size.width, x + reach); ++column) {
          const double along = ((column - x) * u + (row - y) * v) / (scale * blob.long_px);
          const double across = ((row - y) * u - (column - x) * v) / (scale * blob.short_px);
          sum(row, column) +=
              static_cast<float>(blob.height * std::exp(-(along * along + across * across) / 2));
        }
      }
    }
    cv::Mat picture;
    sum.convertTo(picture, CV_8U);
    return picture;
  }

 private:
  struct Blob {
    double x, y, long_px, short_px, angle, height;
  };
  std::vector<Blob> blobs_;
};

/// One round Gaussian blob on grey.
inline cv::Mat gaussian_blob(cv::Size size, double x, double y, double sigma, double height) {
  cv::Mat1b picture(size);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      const double squared = (column - x) * (column - x) + (row - y) * (row - y);
      picture(row, column) =
          cv::saturate_cast<uchar>(128 + height * std::exp(-squared / (2 * sigma * sigma)));
    }
  }
  return picture;
}

/// Independent uniform bytes.
inline cv::Mat noise_picture(cv::Size size, std::uint64_t seed) {
  vo::Rng rng(seed);
  cv::Mat1b picture(size);
  for (uchar& pixel : picture) pixel = static_cast<uchar>(rng.index(256));
  return picture;
}

}  // namespace test_support
