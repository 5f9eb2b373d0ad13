#include "vo/base/frame_range.hpp"

#include <algorithm>
#include <stdexcept>

namespace vo {

FrameRange frames_around(std::span<const double> time_s, FrameRange range, double reach_s) {
  if (range.begin >= range.end || range.end > time_s.size())
    throw std::invalid_argument("frames_around: a range of the walk's frames expected");
  const auto first = std::ranges::lower_bound(time_s, time_s[range.begin] - reach_s);
  const auto last = std::ranges::upper_bound(time_s, time_s[range.end - 1] + reach_s);
  return {static_cast<std::size_t>(first - time_s.begin()), static_cast<std::size_t>(last - time_s.begin())};
}

std::vector<FrameRange> marked_ranges(const std::vector<bool>& marked) {
  std::vector<FrameRange> ranges;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (!marked[i]) continue;
    if (ranges.empty() || ranges.back().end != i) ranges.push_back({i, i});
    ++ranges.back().end;
  }
  return ranges;
}

}  // namespace vo
