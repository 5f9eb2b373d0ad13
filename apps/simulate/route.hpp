#pragma once

#include "options.hpp"
#include "path.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace simulate {

inline constexpr double kSideStreetDepth_m = 30;
/// There and back, with four metres left to the side street's end wall.
inline constexpr double kMaxDetour_m = 2 * (kSideStreetDepth_m - 4);

/// A way off the route at a right angle, open for `kSideStreetDepth_m`.
struct SideStreet {
  std::size_t leg;
  double along_m;  ///< of its middle, from the leg's corner
  int side;        ///< +1 right of the route, -1 left
  double width_m;
};

/// One leg of a route with its own frame of reference.
struct Leg {
  std::size_t index;
  Eigen::Vector2d begin, along, right;  ///< the latter two unit vectors
  double length_m, heading_rad;
  double turn_before_rad, turn_after_rad;  ///< at its two corners, positive to the right

  [[nodiscard]] Eigen::Vector2d at(double along_m, double right_m) const {
    return begin + along * along_m + right * right_m;
  }
  [[nodiscard]] vo::Pose2 pose(double along_m, double right_m) const {
    const Eigen::Vector2d p = at(along_m, right_m);
    return {p.x(), p.y(), heading_rad};
  }
  /// How much further than the leg a parallel line `right_m` to its right reaches at a corner.
  [[nodiscard]] double reach_before_m(double right_m) const;
  [[nodiscard]] double reach_after_m(double right_m) const;
};

/// The line one walks: straight legs, corners, side streets. A longer route begins with the shorter one of
/// the same seed.
struct Route {
  std::vector<Eigen::Vector2d> corners;  ///< from (0, 0) heading north to well beyond the end
  std::vector<SideStreet> side_streets;  ///< in order, at most one per leg
  double corner_radius_m = 1;
  int near_side = 1;  ///< on which side of the street the walker's pavement meets its facades
  Path path;

  [[nodiscard]] Leg leg(std::size_t index) const;
};

/// Draws a route of at least `length_m`. It never turns back by more than 65 degrees from north, so that no
/// leg and no side street meets another leg.
Route make_route(Scene scene, std::uint64_t seed, double length_m);

/// What is walked: the route from `start_m` to `length_m`, with a detour spliced in if one is asked for.
class WalkPath {
 public:
  /// The detour turns into the side street next to the middle of the walk, goes half of `detour_m` off, and
  /// comes back. Throws `vo::Error` if the walk passes no side street to turn into.
  WalkPath(const Route& route, double start_m, double length_m, double detour_m);

  /// All that is walked.
  [[nodiscard]] double walked_m() const { return end_m_ - begin_m_; }
  /// The pose after a distance walked from the beginning, facing along the path.
  [[nodiscard]] vo::Pose2 at(double walked_m) const;
  /// How far along the route that is; on the detour, it creeps from where one left to where one is back.
  [[nodiscard]] double route_distance_m(double walked_m) const;

 private:
  Path route_, spur_;
  double begin_m_, end_m_;   // walked, as if from the route's beginning
  double leave_m_, back_m_;  // the same, of the detour
  double rejoin_m_;          // along the route
};

}  // namespace simulate
