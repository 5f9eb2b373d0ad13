#include "place/describe/vlad.hpp"

#include "place/describe/words.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>
#include <vector>

namespace place {
namespace {

/// For each position along one axis of the picture, the two nearest parts and the share of the second.
struct Shares {
  std::vector<std::size_t> first, second;
  std::vector<float> second_share;
};

Shares shares_of(int positions, double margin, int parts) {
  Shares shares;
  for (int i = 0; i < positions; ++i) {
    const double along = (i + 0.5 + margin) / (positions + 2 * margin);
    const double at = std::clamp(along * parts - 0.5, 0.0, parts - 1.0);
    const int low = static_cast<int>(at);
    shares.first.push_back(static_cast<std::size_t>(low));
    shares.second.push_back(static_cast<std::size_t>(std::min(low + 1, parts - 1)));
    shares.second_share.push_back(static_cast<float>(at - low));
  }
  return shares;
}

void divide_by_length(std::span<float> values) {
  constexpr float kNone = 1e-6F;
  const float length = std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0F));
  for (float& value : values) value = length <= kNone ? 0 : value / length;
}

}  // namespace

FloatRows vlad_columns(const FloatRows& descriptors, const FloatRows& words, const VladGrid& grid) {
  if (grid.down < 1 || grid.across < 1 || grid.rows < 1 || grid.columns < 1 ||
      descriptors.size() != static_cast<std::size_t>(grid.down) * static_cast<std::size_t>(grid.across) ||
      words.width != descriptors.width || words.size() == 0) {
    throw std::invalid_argument(
        "vlad_columns: descriptors at every position of the grid, and words of their size, expected");
  }
  const Shares down = shares_of(grid.down, grid.margin_y, grid.rows),
               across = shares_of(grid.across, grid.margin_x, grid.columns);
  const std::size_t width = descriptors.width, part = words.size() * width;
  FloatRows out =
      make_float_rows(static_cast<std::size_t>(grid.rows) * part, static_cast<std::size_t>(grid.columns));
  std::vector<float> residual(width);
  const std::vector<std::size_t> nearest_to = nearest_words(descriptors, words);
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const std::span<const float> descriptor = descriptors[i];
    const std::size_t nearest = nearest_to[i];
    const std::span<const float> word = words[nearest];
    for (std::size_t k = 0; k < width; ++k) residual[k] = descriptor[k] - word[k];
    const std::size_t y = i / static_cast<std::size_t>(grid.across),
                      x = i % static_cast<std::size_t>(grid.across);
    const auto add = [&](std::size_t row, std::size_t column, float weight) {
      if (weight == 0) return;
      float* sum = out[column].data() + row * part + nearest * width;
      for (std::size_t k = 0; k < width; ++k) sum[k] += weight * residual[k];
    };
    const float lower = down.second_share[y], right = across.second_share[x];
    add(down.first[y], across.first[x], (1 - lower) * (1 - right));
    add(down.first[y], across.second[x], (1 - lower) * right);
    add(down.second[y], across.first[x], lower * (1 - right));
    add(down.second[y], across.second[x], lower * right);
  }
  for (std::size_t column = 0; column < out.size(); ++column) {
    const std::span<float> values = out[column];
    for (std::size_t word = 0; word < values.size(); word += width)
      divide_by_length(values.subspan(word, width));
    for (float& value : values) value = std::copysign(std::sqrt(std::abs(value)), value);
    divide_by_length(values);
  }
  return out;
}

}  // namespace place
