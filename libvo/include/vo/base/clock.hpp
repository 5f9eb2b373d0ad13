#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// The frames per second of a recording where its clock runs evenly: one over the mean of the times between
/// frames that are within a quarter of their median, so that neither jumps nor times rounded to milliseconds
/// count. `time_s` increases; throws `std::invalid_argument` for fewer than two. O(n).
double frame_rate_hz(std::span<const double> time_s);

/// A jump of a recording's clock: frames lost, or the recording paused.
struct ClockGap {
  std::size_t frame = 0;  ///< the first after it
  double length_s = 0;    ///< since the frame before

  bool operator==(const ClockGap&) const = default;
};

/// A clock that shows no frame for less than this only stutters: a walker makes at most one step in it.
inline constexpr double kShortestGap_s = 0.5;
/// In a gap of up to this length the walker is assumed to go on at the pace around it: it is four or five
/// steps, and few people stop or turn off within them. What was walked in a longer gap is not known.
inline constexpr double kLongestFilledGap_s = 3;

/// True for a gap too long to be filled.
inline bool parts_walk(const ClockGap& gap) {
  return gap.length_s > kLongestFilledGap_s;
}

/// The jumps of a clock, in order: at least `kShortestGap_s`, and four times the usual time between frames of
/// a recording with hardly a frame a second. `time_s` increases. Empty for fewer than two frames. O(n).
std::vector<ClockGap> clock_gaps(std::span<const double> time_s);

/// The times with gaps longer than `kLongestFilledGap_s` shortened to it, so that no stage computes anything
/// for the hour in which a recording was paused. O(n).
std::vector<double> without_long_gaps(std::span<const double> time_s);

/// Gives each frame right after a gap the displacement of the gap: its length times the pace around it, which
/// is the mean over the second before and the second after; 0 where the gap is longer than
/// `kLongestFilledGap_s`. `displacement`: of each frame since the one before, in any unit; those at gaps are
/// overwritten. Throws `std::invalid_argument` for another number of times. O(n).
void fill_gaps_by_pace(std::span<const double> time_s, std::span<const ClockGap> gaps,
                       std::vector<double>& displacement);

}  // namespace vo
