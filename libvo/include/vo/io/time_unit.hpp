#pragma once

#include <span>
#include <string_view>

namespace vo {

/// What the times in a file are in.
struct TimeUnit {
  double per_second = 1;
  std::string_view name;  ///< "milliseconds", "microseconds", "nanoseconds"; empty for seconds
};

inline constexpr TimeUnit kMilliseconds{1e3, "milliseconds"}, kMicroseconds{1e6, "microseconds"},
    kNanoseconds{1e9, "nanoseconds"};

/// The unit of the times of a path, as their size says it.
///
/// A clock that counts from 1970 has passed 1.4e9 s. Any other is told by two things: places are a thousandth
/// of a second to `longest_step_s` apart, in the median, and who is on the way makes 0.02 m/s and more. The
/// coarsest unit for which both are so is taken; where nothing moves, the step alone decides.
///
/// `time`: of each place, in the file's unit; `path_length`: through them, in metres or in the unit of a
/// trajectory without scale, 0 where it is not known. Seconds for fewer than two times. O(n).
TimeUnit time_unit(std::span<const double> time, double path_length, double longest_step_s = 60);

}  // namespace vo
