#include "place/route/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace place {

double sampling_unit(std::span<const double> displacement, double n) {
  if (displacement.size() < 2) throw std::invalid_argument("sampling_unit: at least two frames expected");
  if (!(n > 0)) throw std::invalid_argument("sampling_unit: n must be positive");
  const std::span<const double> moved = displacement.subspan(1);
  const auto count = static_cast<double>(moved.size());
  double mean = 0;
  for (const double d : moved) mean += d / count;
  double variance = 0;
  for (const double d : moved) variance += (d - mean) * (d - mean) / count;
  return n * (mean + 2 * std::sqrt(variance));
}

std::vector<std::size_t> resample(std::span<const double> displacement, double unit) {
  if (!(unit > 0)) throw std::invalid_argument("resample: unit must be positive");
  std::vector<std::size_t> keyframes;
  if (displacement.empty()) return keyframes;
  keyframes.push_back(0);
  double travelled = 0;
  double next = unit;
  for (std::size_t i = 1; i < displacement.size(); ++i) {
    const double before = travelled;
    travelled += displacement[i];
    if (travelled < next) continue;
    // The multiples between the two frames: the first may lie nearer to the frame before, the last to this
    // one, and those between have no frame of their own.
    const double last = std::max(next, std::floor(travelled / unit) * unit);
    if (next - before < travelled - next && i - 1 > keyframes.back()) keyframes.push_back(i - 1);
    if (travelled - last <= last - before) keyframes.push_back(i);
    next = last + unit;
  }
  return keyframes;
}

std::vector<std::size_t> every_kth(std::size_t frames, std::size_t k) {
  if (k == 0) throw std::invalid_argument("every_kth: k must be >= 1");
  std::vector<std::size_t> keyframes;
  for (std::size_t i = 0; i < frames; i += k) keyframes.push_back(i);
  return keyframes;
}

}  // namespace place
