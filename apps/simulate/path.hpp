#pragma once

#include <vector>

#include <Eigen/Core>

#include <vo/base/pose2.hpp>

namespace simulate {

/// A way along straight legs whose corners are rounded to arcs, measured by the distance walked.
class Path {
 public:
  /// `corners` are at least two points, metres (east, north), with legs long enough for the arcs of
  /// `radius_m` at their ends and turns below 180 degrees; throws `std::invalid_argument` otherwise.
  Path(const std::vector<Eigen::Vector2d>& corners, double radius_m);

  [[nodiscard]] double length_m() const { return length_m_; }

  /// Where one is after a distance, facing along the path. Beyond the ends it goes straight on.
  [[nodiscard]] vo::Pose2 at(double distance_m) const;

  /// The distance at which one passes the point `along_m` from corner `leg` on the straight to the next.
  [[nodiscard]] double distance_on_leg(std::size_t leg, double along_m) const;

 private:
  struct Piece {
    double begin_m;
    vo::Pose2 begin;
    double curvature;  // 1/m, positive to the right
  };

  std::vector<Piece> pieces_;
  std::vector<double> leg_offsets_m_;  // distance along the path minus distance from the leg's corner
  double length_m_ = 0;
};

/// The pose moved sideways, to its right if positive.
vo::Pose2 moved_right(const vo::Pose2& pose, double by_m);

}  // namespace simulate
