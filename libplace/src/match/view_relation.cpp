#include "place/match/view_relation.hpp"

#include <cmath>
#include <vector>

namespace place {
namespace {

vo::ImagePoint image_point(const vo::ViewPoints& points, std::size_t i) {
  const double azimuth = points.azimuth_rad[i], elevation = points.elevation_rad[i];
  return {std::tan(azimuth), std::tan(elevation) / std::cos(azimuth)};
}

}  // namespace

ViewRelation relate_views(const vo::ViewPoints& reference, const vo::ViewPoints& query,
                          const ViewRelationOptions& options) {
  ViewRelation relation;
  std::vector<float> from_rad, to_rad;
  std::vector<vo::ImagePoint> from, to;
  for (const vo::ViewMatch& match : vo::match_views(reference, query, options.matching)) {
    from_rad.push_back(reference.azimuth_rad[match.from]);
    to_rad.push_back(query.azimuth_rad[match.to]);
    from.push_back(image_point(reference, match.from));
    to.push_back(image_point(query, match.to));
  }
  relation.matches = from.size();
  relation.turn = vo::view_turn(from_rad, to_rad, options.turn);
  if (!relation.turn) return relation;
  const std::optional<vo::TwoViewGeometry> geometry = vo::two_view_geometry(from, to, options.geometry);
  if (!geometry || geometry->parallax_rad < options.min_parallax_rad) return relation;
  // The camera's axes in the first's: x right, y down, z forward.
  const auto& [rotation, position] = geometry->second;
  const double turn_rad = std::atan2(rotation(0, 2), rotation(2, 2));
  if (std::abs(turn_rad - relation.turn->turn_rad) > options.max_apart_rad) return relation;
  relation.bearing = {turn_rad, std::atan2(position[0], position[2])};
  return relation;
}

}  // namespace place
