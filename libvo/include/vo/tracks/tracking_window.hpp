#pragma once

#include "vo/surf/features.hpp"
#include "vo/tracks/matching.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace vo {

/// One point, `span` frames ago and now.
struct TrackedPoint {
  Feature from;
  Feature to;
};

/// What a tracking window saw of one frame.
struct Tracks {
  int span = 0;                      ///< frames between `from` and `to`; 0 for the very first frame
  std::vector<TrackedPoint> points;  ///< in the order of the frame's own features
};

/// Follows interest points over the last `window` frames by chaining the matches of consecutive frames, and
/// compares each with itself `window` frames ago (PVO 4.2, Table 1). A window of 1 is plain matching. A
/// longer window has less noise relative to its motion, but fewer points last: PVO kept 40 % of the matches
/// at 3 (the default) and 28 % at 4.
class TrackingWindow {
 public:
  static constexpr int kMaxWindow = 5;

  /// Throws `std::invalid_argument` unless 1 <= window <= kMaxWindow.
  explicit TrackingWindow(int window = 3);

  /// Takes the next frame's points and their matches from the frame before (`from` there, `to` here; none for
  /// the first), each point in at most one match. During the first `window` frames, points are compared with
  /// the first frame. Throws `std::invalid_argument` if a match names a point that does not exist. O(points +
  /// matches).
  Tracks push(std::span<const Feature> points, std::span<const Match> matches);

 private:
  int window_;
  int frames_ = 0;
  std::vector<std::vector<Feature>>
      histories_;  // of each point of the last frame: itself last, the oldest first
};

}  // namespace vo
