#include "place/evaluation/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace place {

Calibration calibration(std::span<const ProbableMatch> matches, int bins) {
  if (bins < 1) throw std::invalid_argument("calibration: at least one bin expected");
  for (const ProbableMatch& match : matches) {
    if (!(match.probability >= 0 && match.probability <= 1))
      throw std::invalid_argument("calibration: probabilities of 0 to 1 expected");
  }
  std::vector<ProbableMatch> sorted(matches.begin(), matches.end());
  std::ranges::stable_sort(sorted, {}, &ProbableMatch::probability);
  std::vector<double> right(sorted.size());  // matches of one probability share it, whatever their order
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    double sum = 0;
    for (; end < sorted.size() && sorted[end].probability == sorted[begin].probability; ++end)
      sum += sorted[end].right ? 1 : 0;
    for (std::size_t k = begin; k < end; ++k) right[k] = sum / static_cast<double>(end - begin);
  }
  Calibration result;
  const std::size_t count = std::min(sorted.size(), static_cast<std::size_t>(bins));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = i * sorted.size() / count, end = (i + 1) * sorted.size() / count;
    ReliabilityBin bin{
        .matches = end - begin, .lowest = sorted[begin].probability, .highest = sorted[end - 1].probability};
    const auto size = static_cast<double>(bin.matches);
    for (std::size_t k = begin; k < end; ++k) {
      bin.mean += sorted[k].probability / size;
      bin.right += right[k] / size;
    }
    result.error += std::abs(bin.mean - bin.right) * size / static_cast<double>(sorted.size());
    result.bins.push_back(bin);
  }
  return result;
}

}  // namespace place
