#pragma once

#include "vo/tracks/matching.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace vo {

/// The nearest candidates of a point, squared distances.
struct Nearest {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  std::size_t index = kNone;
  float first = std::numeric_limits<float>::infinity();
  float second = std::numeric_limits<float>::infinity();

  /// Among equal distances the lowest index counts as nearest, in any order of calls.
  void offer(std::size_t i, float distance) {
    if (distance < first || (distance == first && i < index)) {
      second = first;
      first = distance;
      index = i;
    } else if (distance < second) {
      second = distance;
    }
  }
};

/// For each point of the first image, its nearest in the second; for each of the second, only the squared
/// distance to its nearest in the first, which is all a mutual test needs.
struct NearestOfBoth {
  std::vector<Nearest> from;
  std::vector<float> to;
};

NearestOfBoth nearest_exact(const Features& from, const Features& to, const MatchOptions& options);

}  // namespace vo
