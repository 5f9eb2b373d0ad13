#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace vo {

/// The value below which a share (0..1) of sorted values lies, linear between neighbours as numpy has it.
/// Throws `std::invalid_argument` if there is none. O(1).
inline double percentile(std::span<const double> sorted, double share) {
  if (sorted.empty()) throw std::invalid_argument("percentile: at least one value expected");
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(position);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return std::lerp(sorted[low], sorted[high], position - static_cast<double>(low));
}

}  // namespace vo
