#include "route.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <vo/base/error.hpp>
#include <vo/base/rng.hpp>
#include <vo/base/trajectory.hpp>

namespace simulate {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMaxHeading = 65 * kDegree;
// A walker turns into a side street and round again within a step or so.
constexpr double kDetourRadius_m = 0.5;
constexpr double kSplice_m = 2;  // the detour leaves and joins the route this far from the side street

struct Layout {
  double leg_min_m, leg_max_m;
  double turn_min_deg, turn_max_deg;
  double corner_radius_m;
  double side_street_width_m;
  double beyond_m;  // drawn after the end, as far as one may see
};

// Street blocks of 28 to 50 m, cut at an arc an unhurried walker takes; corridors are shorter and squarer.
Layout layout_of(Scene scene) {
  if (scene == Scene::kStreet) return {28, 50, 35, 80, 3.0, 5.0, 50};
  return {14, 28, 60, 90, 1.2, 2.4, 25};
}

Eigen::Vector2d forward(double heading_rad) {
  return {std::sin(heading_rad), std::cos(heading_rad)};
}

double next_heading(double heading, const Layout& layout, vo::Rng& rng) {
  const double turn = rng.uniform(layout.turn_min_deg, layout.turn_max_deg) * kDegree;
  const double side = rng.index(2) == 0 ? 1 : -1;
  const double wanted =
      std::abs(heading + side * turn) <= kMaxHeading ? heading + side * turn : heading - side * turn;
  return std::clamp(wanted, -kMaxHeading, kMaxHeading);
}

const SideStreet& nearest_side_street(const Route& route, double distance_m) {
  return *std::ranges::min_element(route.side_streets, {}, [&](const SideStreet& s) {
    return std::abs(route.path.distance_on_leg(s.leg, s.along_m) - distance_m);
  });
}

// Along the route to a side street, in, across, out again beside the way in, and on along the route.
Path make_spur(const Route& route, const SideStreet& street, double detour_m) {
  const Eigen::Vector2d corner = route.corners[street.leg];
  const Eigen::Vector2d along = (route.corners[street.leg + 1] - corner).normalized();
  const Eigen::Vector2d off = street.side * Eigen::Vector2d(along.y(), -along.x());
  const Eigen::Vector2d middle = corner + along * street.along_m;
  const Eigen::Vector2d in = middle - along * kDetourRadius_m;
  const Eigen::Vector2d out = middle + along * kDetourRadius_m;
  const Eigen::Vector2d depth = off * std::max(detour_m / 2, 2 * kDetourRadius_m);
  return Path({middle - along * kSplice_m, in, in + depth, out + depth, out, middle + along * kSplice_m},
              kDetourRadius_m);
}

}  // namespace

Route make_route(Scene scene, std::uint64_t seed, double length_m) {
  const Layout layout = layout_of(scene);
  vo::Rng rng = vo::Rng(seed).split();
  const int near_side = rng.index(2) == 0 ? 1 : -1;
  std::vector<Eigen::Vector2d> corners{{0, 0}};
  std::vector<SideStreet> side_streets;
  double heading = 0;
  // Rounding a corner cuts at most a fifth of the way near it; a little more is drawn than is needed.
  for (double drawn_m = 0; drawn_m < 1.1 * length_m + layout.beyond_m;) {
    const double leg_m = rng.uniform(layout.leg_min_m, layout.leg_max_m);
    const int side = scene == Scene::kStreet ? near_side : (rng.index(2) == 0 ? 1 : -1);
    side_streets.push_back(
        {corners.size() - 1, leg_m * rng.uniform(0.42, 0.55), side, layout.side_street_width_m});
    corners.emplace_back(corners.back() + leg_m * forward(heading));
    heading = next_heading(heading, layout, rng);
    drawn_m += leg_m;
  }
  return {corners, side_streets, layout.corner_radius_m, near_side, Path(corners, layout.corner_radius_m)};
}

double Leg::reach_before_m(double right_m) const {
  return -right_m * std::tan(turn_before_rad / 2);
}

double Leg::reach_after_m(double right_m) const {
  return -right_m * std::tan(turn_after_rad / 2);
}

Leg Route::leg(std::size_t index) const {
  const auto heading = [&](std::size_t i) {
    const Eigen::Vector2d leg = corners[i + 1] - corners[i];
    return std::atan2(leg.x(), leg.y());
  };
  const Eigen::Vector2d whole = corners.at(index + 1) - corners[index];
  const Eigen::Vector2d along = whole.normalized();
  const bool last = index + 2 == corners.size();
  return {index,
          corners[index],
          along,
          {along.y(), -along.x()},
          whole.norm(),
          heading(index),
          index == 0 ? 0 : vo::wrap_angle_rad(heading(index) - heading(index - 1)),
          last ? 0 : vo::wrap_angle_rad(heading(index + 1) - heading(index))};
}

WalkPath::WalkPath(const Route& route, double start_m, double length_m, double detour_m)
    : route_(route.path),
      spur_(route.path),
      begin_m_(start_m),
      end_m_(length_m),
      leave_m_(length_m),
      back_m_(length_m),
      rejoin_m_(length_m) {
  if (!(start_m >= 0 && start_m < length_m && length_m <= route.path.length_m() && detour_m >= 0)) {
    throw std::invalid_argument(
        "WalkPath: 0 <= start_m < length_m <= the route's length, detour_m >= 0 expected");
  }
  if (detour_m == 0) return;
  const SideStreet& street = nearest_side_street(route, (start_m + length_m) / 2);
  const double junction_m = route.path.distance_on_leg(street.leg, street.along_m);
  if (junction_m - kSplice_m < start_m || junction_m + kSplice_m > length_m) {
    throw vo::Error("detour-m", "has no side street to turn into", "a longer walk, or no detour");
  }
  spur_ = make_spur(route, street, detour_m);
  leave_m_ = junction_m - kSplice_m;
  back_m_ = leave_m_ + spur_.length_m();
  rejoin_m_ = junction_m + kSplice_m;
  end_m_ = length_m + back_m_ - rejoin_m_;
}

vo::Pose2 WalkPath::at(double walked_m) const {
  const double s = begin_m_ + walked_m;
  if (s <= leave_m_) return route_.at(s);
  return s < back_m_ ? spur_.at(s - leave_m_) : route_.at(s - back_m_ + rejoin_m_);
}

double WalkPath::route_distance_m(double walked_m) const {
  const double s = begin_m_ + walked_m;
  if (s <= leave_m_) return s;
  if (s >= back_m_) return s - back_m_ + rejoin_m_;
  return std::lerp(leave_m_, rejoin_m_, (s - leave_m_) / (back_m_ - leave_m_));
}

}  // namespace simulate
