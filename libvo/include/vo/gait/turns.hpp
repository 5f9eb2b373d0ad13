#pragma once

#include <span>
#include <vector>

namespace vo {

/// A stretch in which a walker turns.
struct WalkedTurn {
  double begin_s = 0, end_s = 0;
  double turn_rad = 0;  ///< largest change of heading since before it, clockwise positive
};

/// Turns fairly large for a walk: where the headings 1.5 s before and after differ by 30 degrees or more (SSS
/// 6 finds turns in windows of high alignment error; a walker's heading shows them by themselves). A stretch
/// begins and ends where this does, and turns by the largest change from the heading 1.5 s before it to one
/// up to 1.5 s after it, which may be more than one whole turn. Neighbouring turns to different sides are
/// two.
///
/// `heading_rad`: unwrapped, clockwise, low-passed or not: the sway of a step lasts less than a second.
/// `time_s`: of each, increasing. Throws `std::invalid_argument` for another number of times. O(n).
std::vector<WalkedTurn> find_turns(std::span<const double> heading_rad, std::span<const double> time_s);

}  // namespace vo
