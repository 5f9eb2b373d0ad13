#include "path.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include <vo/base/trajectory.hpp>

namespace simulate {
namespace {

vo::Pose2 advance(const vo::Pose2& pose, double curvature, double by_m) {
  const double h0 = pose.heading_rad;
  if (curvature == 0) return {pose.x_m + by_m * std::sin(h0), pose.y_m + by_m * std::cos(h0), h0};
  const double h1 = h0 + curvature * by_m;
  return {pose.x_m + (std::cos(h0) - std::cos(h1)) / curvature,
          pose.y_m + (std::sin(h1) - std::sin(h0)) / curvature, h1};
}

}  // namespace

Path::Path(const std::vector<Eigen::Vector2d>& corners, double radius_m) {
  if (corners.size() < 2 || !(radius_m > 0)) {
    throw std::invalid_argument("Path: at least two corners and a radius above 0 expected");
  }
  double heading = 0;
  double cut_m = 0;  // of the current leg's beginning, by the arc before it
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Eigen::Vector2d leg = corners[i + 1] - corners[i];
    if (i == 0) heading = std::atan2(leg.x(), leg.y());
    double turn = 0;
    if (i + 2 < corners.size()) {
      const Eigen::Vector2d next = corners[i + 2] - corners[i + 1];
      turn = vo::wrap_angle_rad(std::atan2(next.x(), next.y()) - heading);
    }
    const double tangent_m = radius_m * std::tan(std::abs(turn) / 2);
    const double straight_m = leg.norm() - cut_m - tangent_m;
    // A leg may be all arc; rounding then leaves it a hair below zero.
    if (!(straight_m > -1e-9)) throw std::invalid_argument("Path: a leg is too short for its arcs");

    const Eigen::Vector2d start = corners[i] + leg.normalized() * cut_m;
    leg_offsets_m_.push_back(length_m_ - cut_m);
    pieces_.push_back({length_m_, {start.x(), start.y(), heading}, 0});
    length_m_ += straight_m;
    if (turn != 0) {
      const double curvature = std::copysign(1 / radius_m, turn);
      pieces_.push_back({length_m_, advance(pieces_.back().begin, 0, straight_m), curvature});
      length_m_ += std::abs(turn) * radius_m;
      heading += turn;
    }
    cut_m = tangent_m;
  }
}

vo::Pose2 Path::at(double distance_m) const {
  const auto after = std::ranges::upper_bound(pieces_, distance_m, {}, &Piece::begin_m);
  const Piece& piece = after == pieces_.begin() ? pieces_.front() : *std::prev(after);
  return advance(piece.begin, piece.curvature, distance_m - piece.begin_m);
}

double Path::distance_on_leg(std::size_t leg, double along_m) const {
  return leg_offsets_m_.at(leg) + along_m;
}

vo::Pose2 moved_right(const vo::Pose2& pose, double by_m) {
  return {pose.x_m + by_m * std::cos(pose.heading_rad), pose.y_m - by_m * std::sin(pose.heading_rad),
          pose.heading_rad};
}

}  // namespace simulate
