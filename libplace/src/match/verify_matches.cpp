#include "place/match/verify_matches.hpp"

#include "place/match/crossed_bearings.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <vo/base/median.hpp>
#include <vo/base/parallel.hpp>
#include <vo/base/trajectory.hpp>

namespace place {
namespace {

/// The keyframe and those about it, the nearest first, `count` in all if the walk is so long.
std::vector<std::size_t> about(std::size_t keyframe, std::size_t keyframes, std::size_t count) {
  std::vector<std::size_t> nearest{keyframe};
  for (std::size_t off = 1; off < keyframes && nearest.size() < count; ++off) {
    if (keyframe + off < keyframes) nearest.push_back(keyframe + off);
    if (off <= keyframe && nearest.size() < count) nearest.push_back(keyframe - off);
  }
  return nearest;
}

/// A pose in the axes of another: x to its right, y ahead.
vo::Pose2 in_axes_of(const vo::Pose2& origin, const vo::Pose2& pose) {
  const double x = pose.x_m - origin.x_m, y = pose.y_m - origin.y_m;
  const double s = std::sin(origin.heading_rad), c = std::cos(origin.heading_rad);
  return {c * x - s * y, s * x + c * y, vo::wrap_angle_rad(pose.heading_rad - origin.heading_rad)};
}

/// How far to the right of the path through `poses` a place lies.
double right_of_m(const std::vector<vo::Pose2>& poses, const CrossedPlace& place) {
  std::optional<vo::Pose2> nearest;
  for (const vo::Pose2& pose : poses) {
    const vo::Pose2 seen = in_axes_of(pose, {place.x_m, place.y_m, 0});
    if (!nearest || std::abs(seen.y_m) < std::abs(nearest->y_m)) nearest = seen;
  }
  return nearest->x_m;
}

void verify(const Traverse& traverse, const Bytes& query_points, const VerifyOptions& options, Match& match) {
  const vo::ViewPoints query = vo::unpack_view_points(query_points);
  const std::optional<vo::Pose2>& origin = traverse.keyframes.at(match.place->keyframe).pose;
  std::vector<Bearing> bearings;
  std::vector<double> turns_rad;
  std::vector<vo::Pose2> path;
  for (const std::size_t k :
       about(match.place->keyframe, traverse.keyframes.size(), static_cast<std::size_t>(options.places))) {
    const std::optional<vo::Pose2>& pose = traverse.keyframes[k].pose;
    const bool itself = k == match.place->keyframe;
    if (!itself && !(origin && pose)) continue;
    const ViewRelation seen =
        relate_views(vo::unpack_view_points(traverse.view_points.at(k)), query, options.views);
    const vo::Pose2 at = itself ? vo::Pose2{} : in_axes_of(*origin, *pose);
    path.push_back(at);
    if (itself && seen.turn) match.yaw_rad = seen.turn->turn_rad;
    if (!seen.bearing) continue;
    turns_rad.push_back(at.heading_rad + seen.bearing->turn_rad);
    bearings.push_back({at.x_m, at.y_m, at.heading_rad + seen.bearing->bearing_rad});
  }
  if (!turns_rad.empty()) match.yaw_rad = vo::median(turns_rad);
  if (!origin) return;
  const std::optional<CrossedPlace> place = cross_bearings(bearings);
  if (!place || place->x_sd_m > options.max_sd_m) return;
  match.lateral_m = right_of_m(path, *place);
  if (place->y_sd_m <= options.max_sd_m) match.ahead_m = place->y_m;
}

}  // namespace

void verify_matches(const Route& route, std::span<const Bytes> query_points, const VerifyOptions& options,
                    std::vector<Match>& matches) {
  if (query_points.size() != matches.size())
    throw std::invalid_argument("verify_matches: the points of each match expected");
  if (options.places < 1) throw std::invalid_argument("verify_matches: places >= 1 expected");
  vo::parallel_for(matches.size(), [&](std::size_t i) {
    Match& match = matches[i];
    if (!match.place) return;
    const auto traverse = std::ranges::find(route.traverses, match.place->traverse, &Traverse::name);
    if (traverse == route.traverses.end() || traverse->view_points.empty()) return;
    verify(*traverse, query_points[i], options, match);
  });
}

}  // namespace place
