#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace vo {

/// How far a camera is turned to the side between two views of one place.
struct ViewTurn {
  double turn_rad = 0;       ///< of the second view to the right of the first
  std::size_t agreeing = 0;  ///< points that agree on it
};

/// Settings of `view_turn`.
struct ViewTurnOptions {
  double spread_rad = 0.024;     ///< by which points of one turn differ: some are near, some far
  std::size_t min_agreeing = 6;  ///< points
  /// How many more must agree than points matched at random would, in standard deviations of that number.
  double min_over_chance = 3.5;
};

/// The turn that most points vote for: the highest place of the sum of Gaussians about the votes, then their
/// mean about it. This needs no parallax and stands many wrong matches, where an essential matrix has too few
/// right ones (another season, pictures some metres apart).
///
/// `from_rad`, `to_rad`: azimuths of the same points in both views, to the right of the camera's axis. None
/// where too few agree. Throws `std::invalid_argument` unless there are equally many and spread_rad > 0.
/// O(points^2).
std::optional<ViewTurn> view_turn(std::span<const float> from_rad, std::span<const float> to_rad,
                                  const ViewTurnOptions& options = {});

}  // namespace vo
