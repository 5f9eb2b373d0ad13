#pragma once

#include "place/match/match.hpp"
#include "place/route/route.hpp"

#include <span>

namespace place {

/// Gives each match with a place the named place of its route that is nearest to it along its traverse
/// (`places_on`): `Match::nearest_place`, and the metres to it where the traverse is surveyed there. Nearest
/// in metres if the match and all places are surveyed, else in keyframes. Of two as near the first. Without
/// named places nothing changes. Throws `std::invalid_argument` for a place on no traverse or keyframe of the
/// route. O(matches * places), after `places_on` for each traverse.
void name_places(std::span<Match> matches, const Route& route);

}  // namespace place
