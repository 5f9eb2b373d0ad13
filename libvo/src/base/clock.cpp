#include "vo/base/clock.hpp"

#include "vo/base/median.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace vo {
namespace {

std::vector<double> intervals_s(std::span<const double> time_s) {
  std::vector<double> interval_s;
  for (std::size_t i = 1; i < time_s.size(); ++i) interval_s.push_back(time_s[i] - time_s[i - 1]);
  return interval_s;
}

/// What was moved over the second before a gap, or after it, and in how long; not over another gap.
struct Moved {
  double distance = 0;
  double seconds = 0;
};

Moved moved_beside(std::span<const double> time_s, std::span<const ClockGap> gaps,
                   std::span<const double> displacement, const ClockGap& gap, bool after) {
  const auto is_gap = [&](std::size_t i) {
    return std::ranges::binary_search(gaps, i, {}, &ClockGap::frame);
  };
  Moved moved;
  const auto take = [&](std::size_t i) {
    if (is_gap(i)) return false;
    moved.distance += displacement[i];
    moved.seconds += time_s[i] - time_s[i - 1];
    return moved.seconds < 1;
  };
  if (after) {
    for (std::size_t i = gap.frame + 1; i < time_s.size() && take(i);) ++i;
  } else {
    for (std::size_t i = gap.frame; i > 1 && take(i - 1);) --i;
  }
  return moved;
}

}  // namespace

double frame_rate_hz(std::span<const double> time_s) {
  if (time_s.size() < 2) {
    throw std::invalid_argument(
        fmt::format("frame_rate_hz: {} times given; at least 2 expected", time_s.size()));
  }
  constexpr double kNear = 0.25;
  const std::vector<double> interval_s = intervals_s(time_s);
  const double usual_s = median(interval_s);
  double sum_s = 0, count = 0;
  for (const double seconds : interval_s) {
    if (std::abs(seconds - usual_s) > kNear * usual_s) continue;
    sum_s += seconds;
    ++count;
  }
  return count > 0 ? count / sum_s : 1 / usual_s;  // two intervals, unlike each other
}

std::vector<ClockGap> clock_gaps(std::span<const double> time_s) {
  constexpr double kUnusual = 4;
  std::vector<ClockGap> gaps;
  if (time_s.size() < 2) return gaps;
  const double least_s = std::max(kShortestGap_s, kUnusual * median(intervals_s(time_s)));
  for (std::size_t i = 1; i < time_s.size(); ++i)
    if (time_s[i] - time_s[i - 1] >= least_s) gaps.push_back({i, time_s[i] - time_s[i - 1]});
  return gaps;
}

std::vector<double> without_long_gaps(std::span<const double> time_s) {
  std::vector<double> shortened(time_s.begin(), time_s.end());
  double left_out_s = 0;
  auto gap = clock_gaps(time_s);
  std::erase_if(gap, [](const ClockGap& g) { return !parts_walk(g); });
  for (std::size_t i = 0, next = 0; i < shortened.size(); ++i) {
    if (next < gap.size() && gap[next].frame == i) left_out_s += gap[next++].length_s - kLongestFilledGap_s;
    shortened[i] -= left_out_s;
  }
  return shortened;
}

void fill_gaps_by_pace(std::span<const double> time_s, std::span<const ClockGap> gaps,
                       std::vector<double>& displacement) {
  if (time_s.size() != displacement.size())
    throw std::invalid_argument("fill_gaps_by_pace: one time per frame expected");
  for (const ClockGap& gap : gaps) {
    const Moved before = moved_beside(time_s, gaps, displacement, gap, false);
    const Moved after = moved_beside(time_s, gaps, displacement, gap, true);
    const double seconds = before.seconds + after.seconds;
    const double pace = seconds > 0 ? (before.distance + after.distance) / seconds : 0;
    displacement[gap.frame] = parts_walk(gap) ? 0 : pace * gap.length_s;
  }
}

}  // namespace vo
