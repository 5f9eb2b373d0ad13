#include "vo/gait/turns.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace vo {

std::vector<WalkedTurn> find_turns(std::span<const double> heading_rad, std::span<const double> time_s) {
  if (heading_rad.size() != time_s.size())
    throw std::invalid_argument("find_turns: one time for each heading expected");
  constexpr double kReach_s = 1.5, kLeast_rad = std::numbers::pi / 6;
  // Times are rounded to milliseconds.
  constexpr double kRounding_s = 1e-4;
  std::vector<WalkedTurn> turns;
  double before_rad = 0;  // the heading before the turn that is being walked
  bool turning = false;
  for (std::size_t i = 0, from = 0, to = 0; i < time_s.size(); ++i) {
    while (time_s[from] < time_s[i] - kReach_s - kRounding_s) ++from;
    while (to + 1 < time_s.size() && time_s[to + 1] <= time_s[i] + kReach_s + kRounding_s) ++to;
    const double change_rad = heading_rad[to] - heading_rad[from];
    if (std::abs(change_rad) < kLeast_rad) {
      turning = false;
      continue;
    }
    if (!turning || std::signbit(change_rad) != std::signbit(turns.back().turn_rad)) {
      before_rad = heading_rad[from];
      turns.push_back({.begin_s = time_s[i], .turn_rad = change_rad});
      turning = true;
    }
    turns.back().end_s = time_s[i];
    const double turned_rad = heading_rad[to] - before_rad;
    if (std::abs(turned_rad) > std::abs(turns.back().turn_rad)) turns.back().turn_rad = turned_rad;
  }
  return turns;
}

}  // namespace vo
