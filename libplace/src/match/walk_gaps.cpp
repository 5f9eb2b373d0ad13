#include "place/match/walk_gaps.hpp"

#include <stdexcept>

namespace place {

std::vector<Stretch> stretches_between(const std::vector<std::size_t>& gaps, std::size_t count) {
  std::vector<Stretch> stretches;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (i > 0 && gaps[i] <= gaps[i - 1])
      throw std::invalid_argument("stretches_between: gaps that increase expected");
    if (gaps[i] == 0 || gaps[i] >= count) continue;
    stretches.push_back({begin, gaps[i]});
    begin = gaps[i];
  }
  if (begin < count) stretches.push_back({begin, count});
  return stretches;
}

}  // namespace place
