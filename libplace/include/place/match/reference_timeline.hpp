#pragma once

#include "place/match/match.hpp"
#include "place/route/route.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace place {

/// A place on a route between its keyframes.
struct ReferenceMoment {
  std::size_t traverse = 0;          ///< index among the route's
  double keyframe = 0;               ///< index among its keyframes; 2.5 is half way between two of them
  double frame = 0;                  ///< of the traverse's source video
  std::optional<double> distance_m;  ///< along the route, where surveyed; else travelled, if in metres
  std::optional<double> yaw_rad;     ///< see `Match::yaw_rad`
};

/// A frame of the query.
struct QueryMoment {
  std::size_t match = 0;                     ///< the nearest keyframe's
  std::optional<ReferenceMoment> reference;  ///< none where that match is not accepted: off the route
};

/// Where on the route each frame of a query is: the accepted matches, and between them as far along the
/// route as the query has come. It is interpolated between two keyframes in succession that are both
/// accepted, on one traverse, from one to at most five keyframes ahead, with no gap in either walk between
/// them. Otherwise a frame has the place of the nearer keyframe, or none if that one is not accepted. The
/// frames before the first keyframe and after the last have theirs.
///
/// `matches`: with their places on the route (`locate`). `frames`: of the query. `travelled`: displacement
/// of each of them since the first, or empty: frames between two keyframes are then taken to be evenly far
/// apart. `gaps`: matches before which the query was interrupted (`gaps_at`). Throws `std::invalid_argument`
/// for matches that are not in order, lie outside the frames or are on no traverse, and for another number
/// of displacements. O(frames + matches * traverses).
std::vector<QueryMoment> reference_timeline(const Route& route, std::span<const Match> matches,
                                            std::size_t frames, std::span<const double> travelled = {},
                                            std::span<const std::size_t> gaps = {});

}  // namespace place
