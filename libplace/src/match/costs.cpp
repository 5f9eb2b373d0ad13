#include "place/match/costs.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include <vo/base/large_memory.hpp>

namespace place {

CostMatrix make_cost_matrix(std::size_t queries, std::size_t references) {
  CostMatrix matrix{.queries = queries, .references = references, .values = {}};
  vo::resize_populated(matrix.values, queries * references);
  return matrix;
}

CostRange range_of(std::span<const float> costs) {
  // Eight of each at a time, which compilers vectorise.
  constexpr std::size_t kLanes = 8;
  if (costs.empty()) return {};
  std::array<double, kLanes> sums{};
  std::array<float, kLanes> least, most;
  least.fill(costs.front());
  most.fill(costs.front());
  const std::size_t whole = costs.size() - costs.size() % kLanes;
  const auto take = [&](std::size_t i, std::size_t k) {
    sums[k] += costs[i + k];
    least[k] = costs[i + k] < least[k] ? costs[i + k] : least[k];
    most[k] = costs[i + k] > most[k] ? costs[i + k] : most[k];
  };
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) take(i, k);
  }
  for (std::size_t k = 0; whole + k < costs.size(); ++k) take(whole, k);
  const double centre = std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(costs.size());
  return {.centre = centre,
          .largest = std::max(*std::ranges::max_element(most) - centre,
                              centre - static_cast<double>(*std::ranges::min_element(least)))};
}

CostMatrix cost_matrix(const CostSource& source) {
  CostMatrix matrix = make_cost_matrix(source.queries(), source.references());
  source.compute(block_of(matrix));
  return matrix;
}

}  // namespace place
