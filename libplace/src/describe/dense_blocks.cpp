#include "place/describe/dense_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace place {
namespace {

constexpr float kNoise = 100;        // added to the squared length, (grey levels)^2 summed over a cell
constexpr float kClip = 0.2F;        // Lowe 2004
constexpr float kNoTexture = 1e-4F;  // keeps an empty block at 0

std::array<float, kBlockCells> window() {
  std::array<float, kBlockCells> weights{};
  for (int i = 0; i < kBlockCells; ++i) {
    const double u = i - (kBlockCells - 1) / 2.0;
    weights[static_cast<std::size_t>(i)] =
        static_cast<float>(std::exp(-u * u / (2 * (kBlockCells / 2.0) * (kBlockCells / 2.0))));
  }
  return weights;
}

/// Eight running sums, which compilers vectorise.
template <typename Term>
float sum_of(std::span<const float> values, const Term& term) {
  constexpr std::size_t kLanes = 8;
  std::array<float, kLanes> sums{};
  std::size_t i = 0;
  for (; i + kLanes <= values.size(); i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += term(values[i + k]);
  for (std::size_t k = 0; i + k < values.size(); ++k) sums[k] += term(values[i + k]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

void normalise(std::span<float> block) {
  const auto square = [](float v) { return v * v; };
  const float first = 1 / std::sqrt(sum_of(block, square) + kNoise);
  for (float& v : block) v = std::min(v * first, kClip);
  const float second = 1 / std::sqrt(sum_of(block, square) + kNoTexture);
  for (float& v : block) v *= second;
  const float third = 1 / (sum_of(block, [](float v) { return v; }) + 1e-3F);
  for (float& v : block) v = std::sqrt(v * third);
}

}  // namespace

FloatRows dense_blocks(std::span<const float> cells, const CellGrid& grid) {
  if (cells.size() != grid.values() || grid.rows < kBlockCells || grid.columns < kBlockCells)
    throw std::invalid_argument("dense_blocks: the cells of a grid of at least 6 x 6 expected");
  static const std::array<float, kBlockCells> weights = window();
  const auto directions = static_cast<std::size_t>(grid.directions),
             columns = static_cast<std::size_t>(grid.columns);
  const std::size_t down = static_cast<std::size_t>(grid.rows) - kBlockCells + 1,
                    across = columns - kBlockCells + 1;
  FloatRows blocks = make_float_rows(kBlockCells * kBlockCells * directions, down * across);
  for (std::size_t y = 0; y < down; ++y) {
    for (std::size_t x = 0; x < across; ++x) {
      const std::span<float> block = blocks[y * across + x];
      float* out = block.data();
      for (std::size_t v = 0; v < kBlockCells; ++v) {
        const float* in = cells.data() + ((y + v) * columns + x) * directions;
        for (std::size_t u = 0; u < kBlockCells; ++u) {
          const float weight = weights[v] * weights[u];
          for (std::size_t k = 0; k < directions; ++k) *out++ = weight * *in++;
        }
      }
      normalise(block);
    }
  }
  return blocks;
}

}  // namespace place
