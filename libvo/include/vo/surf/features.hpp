#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vo {

/// An interest point: a blob of the image, with the direction its neighbourhood points in.
struct Feature {
  float x_px = 0;             ///< to the right, 0 at the centre of the first column
  float y_px = 0;             ///< down, 0 at the centre of the first row
  float scale_px = 0;         ///< sigma of the Gaussian that the detector's filter stands for
  float orientation_rad = 0;  ///< in (-pi, pi], from +x towards +y (clockwise as seen); 0 if upright
  float response = 0;         ///< determinant of the Hessian, normalised by scale
  std::int8_t laplacian = 1;  ///< sign of the trace: +1 dark blob on light, -1 light on dark
};

/// The interest points of one image and their descriptors.
struct Features {
  std::vector<Feature> points;
  std::vector<float> descriptors;   ///< points.size() rows of descriptor_size values, each row of unit length
  std::size_t descriptor_size = 0;  ///< 64, or 128 if extended

  [[nodiscard]] std::size_t size() const { return points.size(); }
  [[nodiscard]] std::span<const float> descriptor(std::size_t i) const {
    return {descriptors.data() + i * descriptor_size, descriptor_size};
  }
};

}  // namespace vo
