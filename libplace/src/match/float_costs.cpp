#include "place/match/float_costs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include <vo/base/parallel.hpp>

namespace place {
namespace {

/// Eight running sums, which compilers turn into vectors.
template <typename Term>
float sum_over(std::span<const float> a, std::span<const float> b, const Term& term) {
  constexpr std::size_t kLanes = 8;
  std::array<float, kLanes> sums{};
  std::size_t i = 0;
  for (; i + kLanes <= a.size(); i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += term(a[i + k], b[i + k]);
  for (std::size_t k = 0; i + k < a.size(); ++k) sums[k] += term(a[i + k], b[i + k]);
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

float product(float a, float b) {
  return a * b;
}

std::vector<float> lengths_of(const FloatRows& rows) {
  std::vector<float> lengths(rows.size());
  for (std::size_t i = 0; i < lengths.size(); ++i)
    lengths[i] = std::sqrt(sum_over(rows[i], rows[i], product));
  return lengths;
}

float largest_of(const FloatRows& rows) {
  float largest = 0;
  for (const float value : rows.values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

FloatCosts::FloatCosts(const FloatRows& queries, const FloatRows& references, Metric metric)
    : queries_(queries), references_(references), metric_(metric) {
  if (queries.width != references.width)
    throw std::invalid_argument("FloatCosts: query and reference descriptors differ in size");
  float largest_cost = 2;
  if (metric == Metric::kCosine) {
    query_lengths_ = lengths_of(queries);
    reference_lengths_ = lengths_of(references);
  } else {
    largest_cost = largest_of(queries) + largest_of(references);
    if (metric == Metric::kL2) largest_cost *= std::sqrt(static_cast<float>(queries.width));
  }
  // The power of two of which no cost is more than 2^16 multiples, which fit what is kept of a cost.
  constexpr int kBits = 16;
  if (largest_cost > 0) unit_ = std::exp2(std::ceil(std::log2(largest_cost)) - static_cast<float>(kBits));
}

void FloatCosts::compute(const Costs& block) const {
  const float per_unit = 1 / unit_;
  vo::parallel_for(block.queries, [&](std::size_t i) {
    const std::size_t q = block.first_query + i;
    const std::span<float> row = block.row(i);
    for (std::size_t j = 0; j < row.size(); ++j) {
      const std::size_t r = block.first_reference + j;
      float cost = 0;
      if (metric_ == Metric::kCosine) {
        const float lengths = query_lengths_[q] * reference_lengths_[r];
        cost = 1 - (lengths > 0 ? sum_over(queries_[q], references_[r], product) / lengths : 0);
      } else if (metric_ == Metric::kL1) {
        cost = sum_over(queries_[q], references_[r], [](float a, float b) { return std::abs(a - b); }) /
               static_cast<float>(queries_.width);
      } else {
        cost = std::sqrt(
            sum_over(queries_[q], references_[r], [](float a, float b) { return (a - b) * (a - b); }));
      }
      row[j] = std::max(0.0F, std::nearbyint(cost * per_unit)) * unit_;
    }
  });
}

}  // namespace place
