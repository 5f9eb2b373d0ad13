#pragma once

#include <algorithm>
#include <concepts>
#include <stdexcept>
#include <vector>

namespace vo {

/// The middle value; of an even number the mean of the two in the middle. Throws `std::invalid_argument` if
/// there is none. O(n).
template <std::floating_point T>
T median(std::vector<T> values) {
  if (values.empty()) throw std::invalid_argument("median: at least one value expected");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

}  // namespace vo
