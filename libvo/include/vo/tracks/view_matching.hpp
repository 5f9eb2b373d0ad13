#pragma once

#include "vo/tracks/view_points.hpp"

#include <cstddef>
#include <vector>

namespace vo {

/// One point seen in two views.
struct ViewMatch {
  std::size_t from = 0;  ///< index among the first view's points
  std::size_t to = 0;    ///< among the second's

  friend bool operator==(const ViewMatch&, const ViewMatch&) = default;
};

/// Settings of `match_views`.
struct ViewMatchOptions {
  double max_ratio = 0.93;          ///< of the nearest distance to the second nearest, in (0, 1]
  double max_elevation_rad = 0.12;  ///< how far up or down a point may have moved, >= 0
  double max_octaves = 0.5;         ///< how much larger or smaller it may have become, >= 0
};

/// The points that two views of one place have in common, by index of `to`: pairs that are each other's
/// nearest by their descriptors, among points of the same sign, at about one elevation and of about one size,
/// and nearer by the ratio than any other candidate of either. The azimuth is free: a walker's camera turns
/// to the side by any angle, but nods and rolls by few degrees. Points with one candidate pass the ratio.
///
/// Throws `std::invalid_argument` for options out of range. O(points^2), 0.2 ms for 200 and 200.
std::vector<ViewMatch> match_views(const ViewPoints& from, const ViewPoints& to,
                                   const ViewMatchOptions& options = {});

}  // namespace vo
