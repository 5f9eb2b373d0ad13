#include "place/match/walk_gaps.hpp"

#include <algorithm>
#include <stdexcept>

#include <vo/base/clock.hpp>

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

std::vector<std::size_t> gaps_at(std::span<const std::size_t> frames, std::span<const double> time_s) {
  if (!frames.empty() && frames.back() >= time_s.size())
    throw std::invalid_argument("gaps_at: keyframes among the frames expected");
  std::vector<std::size_t> gaps;
  for (const vo::ClockGap& gap : vo::clock_gaps(time_s)) {
    if (!vo::parts_walk(gap)) continue;
    const auto after = static_cast<std::size_t>(std::ranges::lower_bound(frames, gap.frame) - frames.begin());
    // Two jumps between the same keyframes are one gap.
    if (after > 0 && after < frames.size() && (gaps.empty() || gaps.back() < after)) gaps.push_back(after);
  }
  return gaps;
}

}  // namespace place
