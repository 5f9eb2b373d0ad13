#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace place {

/// Keyframes before which a walk was interrupted (its clock jumps, the camera was off): k means a gap between
/// keyframes k - 1 and k. No sequence crosses one. Increasing; 0 or an index past the end is ignored.
struct WalkGaps {
  std::vector<std::size_t> query;
  std::vector<std::size_t> reference;

  [[nodiscard]] bool empty() const { return query.empty() && reference.empty(); }
};

/// Keyframes [begin, end) of a walk.
struct Stretch {
  std::size_t begin = 0, end = 0;

  bool operator==(const Stretch&) const = default;
};

/// The stretches of a walk of `count` keyframes between its gaps, in order; none for an empty walk. Throws
/// `std::invalid_argument` if `gaps` does not increase.
std::vector<Stretch> stretches_between(const std::vector<std::size_t>& gaps, std::size_t count);

/// The keyframes before which a walk's clock jumped for so long that the distance is unknown
/// (`vo::parts_walk`). `frames`: the keyframes, increasing; `time_s`: of all frames, increasing. Throws
/// `std::invalid_argument` for keyframes that are not among them. O(frames).
std::vector<std::size_t> gaps_at(std::span<const std::size_t> frames, std::span<const double> time_s);

}  // namespace place
