#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// Frames [begin, end).
struct FrameRange {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const { return end - begin; }
  bool operator==(const FrameRange&) const = default;
};

/// The frames no more than `reach_s` seconds away from any of a range, the range among them. `time_s`: of
/// each frame, increasing. Throws `std::invalid_argument` for an empty range or one past the end. O(log n).
FrameRange frames_around(std::span<const double> time_s, FrameRange range, double reach_s);

/// The longest ranges all of whose frames are marked, in order. O(n).
std::vector<FrameRange> marked_ranges(const std::vector<bool>& marked);

}  // namespace vo
