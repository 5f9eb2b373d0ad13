#include "place/match/shifted_cosine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

constexpr float kUnitsOfOne = 32768;
constexpr std::size_t kMostBytes = 130'000;  // of a descriptor: 127^2 times that is below 2^31

/// sqrt(factor / sum of squares) of every descriptor over the columns that each shift leaves it, [keyframe]
/// [shift]; 0 where all are 0. `sign`: 1 of queries, whose columns lie further on, -1 of references.
std::vector<float> scales_of(const ColumnStack& stack, int max_shift, int sign, bool with_share) {
  const auto shifts = static_cast<std::size_t>(2 * max_shift + 1);
  const auto channels = static_cast<std::size_t>(stack.channels);
  std::vector<float> scales(stack.size() * shifts);
  vo::parallel_for(stack.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < shifts; ++k) {
      const int shift = sign * (static_cast<int>(k) - max_shift), overlap = stack.columns - std::abs(shift);
      const auto first = static_cast<std::size_t>(std::max(0, shift));
      double squares = 0;
      for (const std::int8_t value :
           stack[i].subspan(first * channels, static_cast<std::size_t>(overlap) * channels))
        squares += value * value;
      const double factor = with_share ? static_cast<double>(overlap) / stack.columns : 1;
      scales[i * shifts + k] = squares > 0 ? static_cast<float>(std::sqrt(factor / squares)) : 0.0F;
    }
  });
  return scales;
}

std::int32_t product_of(const std::int8_t* a, const std::int8_t* b, std::size_t count) {
  std::int32_t sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

struct ShiftedCosine::State {
  const ColumnStack& queries;
  const ColumnStack& references;
  int max_shift;
  std::vector<float> query_scales, reference_scales;

  [[nodiscard]] float cost(std::size_t q, std::size_t r) const {
    const auto channels = static_cast<std::size_t>(queries.channels);
    const auto shifts = static_cast<std::size_t>(2 * max_shift + 1);
    float most = -1;
    for (std::size_t k = 0; k < shifts; ++k) {
      const int shift = static_cast<int>(k) - max_shift;
      const auto right = static_cast<std::size_t>(std::max(0, shift)),
                 left = static_cast<std::size_t>(std::max(0, -shift));
      const std::size_t columns = static_cast<std::size_t>(queries.columns) - right - left;
      const std::int32_t product = product_of(queries[q].data() + right * channels,
                                              references[r].data() + left * channels, columns * channels);
      const float scaled = static_cast<float>(product) * reference_scales[r * shifts + k];
      most = std::max(most, scaled * query_scales[q * shifts + k]);
    }
    return std::nearbyint((1 - most) * kUnitsOfOne) / kUnitsOfOne;
  }
};

ShiftedCosine::ShiftedCosine(const ColumnStack& queries, const ColumnStack& references,
                             const ShiftedCosineOptions& options) {
  const int shift = options.max_shift_columns;
  if (queries.columns != references.columns || queries.channels != references.channels)
    throw std::invalid_argument("ShiftedCosine: query and reference descriptors differ in size");
  if (shift < 0 || (queries.columns > 0 && shift >= queries.columns))
    throw std::invalid_argument("ShiftedCosine: 0 <= max_shift_columns < columns expected");
  if (queries.descriptor_size() > kMostBytes)
    throw std::invalid_argument("ShiftedCosine: descriptors of at most 130,000 bytes expected");
  state_.reset(new State{queries, references, shift, scales_of(queries, shift, 1, true),
                         scales_of(references, shift, -1, false)});
}

ShiftedCosine::~ShiftedCosine() = default;

std::size_t ShiftedCosine::queries() const {
  return state_->queries.size();
}

std::size_t ShiftedCosine::references() const {
  return state_->references.size();
}

float ShiftedCosine::unit() const {
  return 1 / kUnitsOfOne;
}

void ShiftedCosine::compute(const Costs& block) const {
  vo::parallel_for(block.queries, [&](std::size_t i) {
    const std::span<float> row = block.row(i);
    for (std::size_t j = 0; j < row.size(); ++j)
      row[j] = state_->cost(block.first_query + i, block.first_reference + j);
  });
}

}  // namespace place
