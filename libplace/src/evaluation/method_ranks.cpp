#include "place/evaluation/method_ranks.hpp"

#include <cstddef>
#include <stdexcept>

namespace place {

std::vector<double> mean_ranks(const std::vector<std::vector<std::optional<double>>>& figures) {
  if (figures.empty()) return {};
  std::vector<double> sums(figures.front().size(), 0.0);
  for (const auto& of_set : figures) {
    if (of_set.size() != sums.size())
      throw std::invalid_argument("mean_ranks: a figure or none of every method on every data set expected");
    for (std::size_t m = 0; m < of_set.size(); ++m) {
      double better = 0, equal = 0;  // `equal` counts the method itself; none is less than any figure
      for (const std::optional<double>& other : of_set) {
        better += other > of_set[m] ? 1 : 0;
        equal += other == of_set[m] ? 1 : 0;
      }
      sums[m] += better + (equal + 1) / 2;
    }
  }
  for (double& sum : sums) sum /= static_cast<double>(figures.size());
  return sums;
}

}  // namespace place
