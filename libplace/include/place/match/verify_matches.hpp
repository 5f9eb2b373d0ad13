#pragma once

#include "place/match/match.hpp"
#include "place/match/view_relation.hpp"
#include "place/route/route.hpp"

#include <span>
#include <vector>

namespace place {

/// Settings of `verify_matches`.
struct VerifyOptions {
  int places = 7;         ///< reference keyframes about a match that are looked at again, >= 1
  double max_sd_m = 0.3;  ///< of `lateral_m` and `ahead_m`, beyond which there is none
  ViewRelationOptions views;
};

/// Looks again at where a walk was found, by the SURF points of its keyframes and of the route's, and fills
/// in `Match::yaw_rad`, `Match::lateral_m` and `Match::ahead_m`; all else of the matches stays as it is.
///
/// The best places of a keyframe are the matched one and those before and after it, `places` in all. Each
/// gives the camera's turn against it, and a direction to it where there is parallax (`relate_views`).
/// Directions from several known places cross where the walker was (`cross_bearings`): from the one matched
/// alone nobody knows how far. The turn is the median of those that have a direction, each taken over to the
/// matched keyframe by their headings, else the votes' at the matched one.
///
/// Metres need poses, of a survey or of odometry, at the matched keyframe and about it. All are relative to
/// the reference, whose camera is taken to look where its poses head. `query_points`: of each match
/// (`vo::pack_view_points`). Throws `std::invalid_argument` for another number of them or options out of
/// range. About `places` times 1.3 ms for a match, in parallel.
void verify_matches(const Route& route, std::span<const Bytes> query_points, const VerifyOptions& options,
                    std::vector<Match>& matches);

}  // namespace place
