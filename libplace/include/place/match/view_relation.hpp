#pragma once

#include <cstddef>
#include <optional>

#include <vo/geometry/two_view_geometry.hpp>
#include <vo/geometry/view_turn.hpp>
#include <vo/tracks/view_matching.hpp>

namespace place {

/// How a query's camera stands to a reference's, seen from the reference's camera, in the horizontal plane.
struct ViewBearing {
  double turn_rad = 0;  ///< it is turned to the right by
  double bearing_rad =
      0;  ///< it stands in this direction, clockwise from straight ahead; how far is not known
};

/// What the points of two views say.
struct ViewRelation {
  std::size_t matches = 0;             ///< points in both views
  std::optional<vo::ViewTurn> turn;    ///< what most of them agree on; none where the views share too little
  std::optional<ViewBearing> bearing;  ///< none as well where they show too little parallax
};

/// Settings of `relate_views`.
struct ViewRelationOptions {
  vo::ViewMatchOptions matching;
  vo::ViewTurnOptions turn;
  vo::TwoViewOptions geometry{.noise = 2e-3, .min_inliers = 15};
  double min_parallax_rad = 0.01;  ///< median of the points', below which there is no bearing
  double max_apart_rad = 0.15;     ///< between the turns by votes and by geometry, beyond which there is none
};

/// Relates two views of about one place: points in common (`vo::match_views`), the turn that most agree on
/// (`vo::view_turn`), and by the essential matrix (`vo::two_view_geometry`) the exact turn and the direction.
/// An essential matrix of few points fits anything, so it counts only where it agrees with the votes. About
/// 1.2 ms.
ViewRelation relate_views(const vo::ViewPoints& reference, const vo::ViewPoints& query,
                          const ViewRelationOptions& options = {});

}  // namespace place
