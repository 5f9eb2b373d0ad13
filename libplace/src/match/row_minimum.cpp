#include "match/row_minimum.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace place {
namespace {

constexpr float kHighest = std::numeric_limits<float>::infinity();

float least_of(std::span<const float> row) {
  // Sixteen minima side by side, which the compiler vectorises; the least is the same in any order.
  constexpr std::size_t kSide = 16;
  std::array<float, kSide> least;
  least.fill(kHighest);
  std::size_t i = 0;
  for (; i + kSide <= row.size(); i += kSide) {
    for (std::size_t j = 0; j < kSide; ++j) least[j] = row[i + j] < least[j] ? row[i + j] : least[j];
  }
  for (; i < row.size(); ++i) least[0] = row[i] < least[0] ? row[i] : least[0];
  return *std::ranges::min_element(least);
}

}  // namespace

RowMinimum row_minimum(std::span<const float> row) {
  const float least = least_of(row);
  if (!(least < kHighest)) return {row.size(), kHighest};
  return {static_cast<std::size_t>(std::ranges::find(row, least) - row.begin()), least};
}

float minimum_outside(std::span<const float> row, std::size_t from, std::size_t window) {
  const std::size_t before = from - std::min(from, window), after = std::min(row.size(), from + window + 1);
  return std::min(least_of(row.first(before)), least_of(row.subspan(after)));
}

}  // namespace place
