#include "vo/surf/descriptor.hpp"

#include "surf/raster.hpp"

#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace vo {
namespace {

constexpr int kOverlap = 2;               // samples that a subregion reaches into its neighbours
constexpr double kCellDeviation = 2.5;    // of a subregion's own weights, in scales
constexpr double kSquareDeviation = 7.5;  // of the subregions' weights about the point, in scales

kernels::DescriptorWeights descriptor_weights() {
  constexpr int kCell = kernels::kDescriptorSamples / kernels::kDescriptorCells;
  kernels::DescriptorWeights weights{};
  for (int i = 0; i < kernels::kDescriptorCells; ++i) {
    const double middle = i * kCell + (kCell - 1) / 2.0;
    const double from_point = middle - (kernels::kDescriptorSamples - 1) / 2.0;
    for (int k = 0; k < kernels::kDescriptorSamples; ++k) {
      const double distance = std::abs(k - middle);
      if (distance > kCell / 2 + kOverlap) continue;
      weights.values[i][k] =
          static_cast<float>(std::exp(-distance * distance / (2 * kCellDeviation * kCellDeviation) -
                                      from_point * from_point / (2 * kSquareDeviation * kSquareDeviation)));
    }
  }
  return weights;
}

}  // namespace

void describe(const SmoothPyramid& pyramid, const Feature& point, std::span<float> out) {
  if (out.size() != 64 && out.size() != 128)
    throw std::invalid_argument("describe: room for 64 or 128 values expected");
  static const kernels::DescriptorWeights weights = descriptor_weights();
  const SmoothLevel& level = pyramid.level(point.scale_px);
  kernels::kernels().descriptor_sums(raster_of(level),
                                     grid_at(level, point, point.scale_px, point.orientation_rad), weights,
                                     out.size() == 128, out.data());
  float squared = 0;
  for (const float value : out) squared += value * value;
  if (squared == 0) return;
  const float inverse = 1 / std::sqrt(squared);
  for (float& value : out) value *= inverse;
}

}  // namespace vo
